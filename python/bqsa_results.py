"""Reads what bqsa-bench has recorded. Python 3 and its standard library.

  import bqsa_results
  runs = bqsa_results.load("results/paper_scenarios")
  for (scenario, variant), group in runs.group_by("scenario.name", "variant").items():
      print(scenario, variant, group.success_rate())

A run has the keys of its record (docs/results-format.md) as attributes, `run.judged.clearance_m`, null
being None. A time says something only of a run that was judged a success: `run.valid_times` has none
of others.
"""
import collections
import csv
import json
import math
import pathlib
import re
import warnings

SCHEMA = "bqsa-run/1"
PLAN_SCHEMA = "bqsa-plan/1"
NANOSECOND = 1e-9  # unit of step times in histograms [s]


class Record(dict):
    """A JSON object whose keys are attributes too. Keys that dict has as methods are read as items."""

    def __getattr__(self, key):
        try:
            return self[key]
        except KeyError:
            raise AttributeError(f"the record has no {key!r}; it has {', '.join(self)}") from None

    def at(self, path, default=None):
        """What stands at `judged.clearance_m`; the default if a key is missing, as in older records."""
        value = self
        for key in path.split("."):
            if not isinstance(value, dict) or key not in value:
                return default
            value = value[key]
        return value


class Trajectory:
    """Joint angles at the ticks, the start included: times `t` [s], rows `q` [rad]."""

    def __init__(self, file):
        with open(file, newline="", encoding="utf-8") as stream:
            rows = list(csv.reader(stream))
        joints = len(rows[0]) - 1 if rows else 0
        if not rows or rows[0] != ["t"] + [f"q{i + 1}" for i in range(joints)]:
            raise ValueError(f"{file}: expected a header t,q1..qn, got {rows[:1]}")
        self.t = [float(row[0]) for row in rows[1:]]
        self.q = [[float(angle) for angle in row[1:]] for row in rows[1:]]

    def __len__(self):
        return len(self.t)


class Run:
    """One record. What is not here is looked up in it: `run.scenario.name`."""

    def __init__(self, record, directory, place):
        self.record = record        # Record
        self.directory = directory  # of the results
        self.place = place          # file and line
        self._trajectory = None

    def __getattr__(self, key):
        if key.startswith("__") or key == "record":
            raise AttributeError(key)
        return getattr(self.record, key)

    def __repr__(self):
        return f"<Run of {self.variant} on {self.record.scenario.name}: {self.status}>"

    def at(self, path, default=None):
        """Record.at(), which knows the properties of a run as well."""
        first, *rest = path.split(".")
        if not rest and isinstance(getattr(type(self), first, None), property):
            return getattr(self, first)
        return self.record.at(path, default)

    @property
    def variant(self):
        return self.record.method.variant

    @property
    def family(self):
        return family_of(self.record.scenario.name)

    @property
    def robot(self):
        """Its name; None if it has none, and of older records."""
        return self.record.at("problem.robot")

    @property
    def applicable(self):
        return self.record.judged is not None

    @property
    def success(self):
        """As judged; None if the pair does not fit."""
        return self.record.judged.success if self.applicable else None

    @property
    def status(self):
        """`success`, the judge's most telling failure, or `not applicable`."""
        if not self.applicable:
            return "not applicable"
        if self.success:
            return "success"
        telling = [failure for failure in self.record.judged.failures if failure != "incomplete"]
        return (telling + ["incomplete"])[0]

    @property
    def key(self):
        """Of a run of a campaign."""
        return self.record.at("campaign.key")

    @property
    def repetition(self):
        return self.record.at("campaign.repetition", 1)

    @property
    def valid_times(self):
        """The times of a run that was judged a success, an empty Record for others."""
        return self.record.times if self.success else Record()

    @property
    def trajectory_file(self):
        return self.directory / self.record.trajectory if self.record.trajectory else None

    @property
    def trajectory(self):
        """Read when it is asked for; None if there is none."""
        if self._trajectory is None and self.trajectory_file is not None:
            self._trajectory = Trajectory(self.trajectory_file)
        return self._trajectory


class Rate(collections.namedtuple("Rate", "successes runs lower upper")):
    """How many runs succeeded, with Wilson's interval of 95 % for the probability."""

    @property
    def share(self):
        return self.successes / self.runs if self.runs else math.nan

    def __str__(self):
        return (f"{self.successes} of {self.runs} ({100 * self.share:.1f} %, "
                f"{100 * self.lower:.1f} .. {100 * self.upper:.1f} %)")


class Runs(list):
    """Runs that were judged, as a list with questions. Of load() it also knows what is not in it."""

    def __init__(self, runs=(), not_applicable=(), superseded=0, stale=0, missing=0):
        super().__init__(runs)
        self.not_applicable = list(not_applicable)  # pairs that do not fit
        self.superseded = superseded                # repeated later
        self.stale = stale                          # not of the campaign's plan
        self.missing = missing                      # of the plan, without a record

    def filter(self, condition=None, **values):
        """Those that meet a condition and have the values given: filter(variant="bqsa", success=True).
        In names of values `__` stands for the point: filter(scenario__name="planar_7r")."""
        paths = {name.replace("__", "."): value for name, value in values.items()}
        return Runs(run for run in self if (condition is None or condition(run)) and
                    all(run.at(path) == value for path, value in paths.items()))

    def group_by(self, *keys):
        """Groups in order of appearance, by paths such as "method.parameters.gain" or functions of a
        run; the keys are tuples if there are several."""
        groups = {}
        for run in self:
            values = tuple(key(run) if callable(key) else run.at(key) for key in keys)
            groups.setdefault(values if len(keys) != 1 else values[0], Runs()).append(run)
        return groups

    def values(self, path):
        """What stands at a path, of the runs that have something there. Times are of successes only."""
        path = re.sub(r"^times\.", "valid_times.", path)
        found = (run.valid_times.at(path.partition(".")[2]) if path.startswith("valid_times.")
                 else run.at(path) for run in self)
        return [value for value in found if value is not None]

    @property
    def successes(self):
        return Runs(run for run in self if run.success)

    def success_rate(self):
        successes = sum(run.success for run in self)
        return Rate(successes, len(self), *wilson_interval(successes, len(self)))

    def step_time(self, share):
        """The time [s] that this share of all ticks from 2 on of all successes does not exceed, to 2.2 %.
        None if no tick was timed."""
        counts = collections.Counter()
        slowest = 0.0  # a bin may reach beyond it
        for run in self.successes:
            for bin_, count in run.valid_times.get("warm_histogram", []):
                counts[bin_] += count
            slowest = max(slowest, run.valid_times.get("warm_max_s") or 0.0)
        below, rank = 0, math.ceil(share * sum(counts.values()))
        for bin_ in sorted(counts):
            below += counts[bin_]
            if below >= rank:
                return min(NANOSECOND * (2 ** ((bin_ - 0.5) / 16) if bin_ > 0 else 0), slowest)
        return None


def wilson_interval(successes, runs):
    """Wilson's score interval of 95 %, as the program's; the whole range if there were no runs."""
    if runs == 0:
        return 0.0, 1.0
    z = 1.959963984540054
    share = successes / runs
    scale = 1 / (1 + z * z / runs)
    middle = scale * (share + z * z / (2 * runs))
    half = scale * z * math.sqrt(share * (1 - share) / runs + z * z / (4 * runs * runs))
    return max(0.0, middle - half), min(1.0, middle + half)


def family_of(scenario):
    """The name without an end `_s<seed>_<number>`, or else without digits at the end."""
    generated = re.fullmatch(r"(.+)_s[0-9]+_[0-9]+", scenario, re.DOTALL)
    if generated:
        return generated[1]
    kept = re.sub(r"[_-]*[0-9]+\Z", "", scenario)
    return kept or scenario


def record_files(directory):
    """runs.jsonl, then the shards of a campaign, complete ones before those under way."""
    shards = []
    for file in (directory / "shards").glob("*.jsonl"):
        shard = re.fullmatch(r"([0-9]+)-of-([0-9]+)(\.part)?\.jsonl", file.name)
        if shard and 1 <= int(shard[1]) <= int(shard[2]):
            shards.append((bool(shard[3]), int(shard[2]), int(shard[1]), file))
    files = [file for *_, file in sorted(shards)]
    runs = directory / "runs.jsonl"
    return [runs] + files if not files or runs.exists() else files


def refuse_constant(name):
    raise ValueError(f"{name} is not JSON")


def fault_of(record):
    """What keeps a JSON value from being a record; None if nothing does."""
    if not isinstance(record, Record) or record.get("schema") != SCHEMA:
        return f"not a record of {SCHEMA}"
    for path in ("scenario.name", "scenario.sha256", "method.variant", "claimed.status"):
        if not isinstance(record.at(path), str):
            return f"not a run record: {path}: expected a text"
    if "judged" not in record:
        return "not a run record: judged: missing"
    if record.judged is not None and record.at("judged.success") != (record.at("judged.failures") == []):
        return "not a run record: judged.success contradicts judged.failures"
    if record.judged is not None and not isinstance(record.get("times"), Record):
        return "not a run record: times: expected an object"
    return None


def read_records(file):
    """(line, Record) of each line that is one; warns of the others."""
    with open(file, "rb") as stream:
        for number, line in enumerate(stream, 1):
            if not line.rstrip(b"\n"):
                continue
            try:
                record = json.loads(line.decode("utf-8"), object_hook=Record,
                                    parse_constant=refuse_constant)
                fault = fault_of(record)
            except ValueError:
                fault = "cut short or damaged"
            if fault:
                warnings.warn(f"{file}:{number}: {fault}; left out", stacklevel=3)
            else:
                yield number, record


def planned_keys(directory):
    """Keys of the campaign's plan in its order; None if there is no plan."""
    file = directory / "plan.jsonl"
    if not file.exists():
        return None
    with open(file, encoding="utf-8") as stream:
        lines = [json.loads(line) for line in stream]
    head = lines[0] if lines else {}
    if head.get("schema") != PLAN_SCHEMA or head.get("runs") != len(lines) - 1:
        raise ValueError(f"{file}: expected a whole plan of {PLAN_SCHEMA}")
    return [line["key"] for line in lines[1:]]


def identity(run):
    """Of runs that have this in common the last counts."""
    return (run.record.scenario.name, run.record.scenario.sha256, run.variant,
            run.at("method.seed"), run.key, run.repetition)


def load(directory):
    """All runs of a results directory that count, as Runs: of a campaign those of its plan, in its order,
    else in order of appearance. Of several of the same scenario file, variant, seed and repetition the last
    counts. Warns of lines that are no records, and of records that are not of the plan."""
    directory = pathlib.Path(directory)
    keys = planned_keys(directory)
    places = None if keys is None else {key: place for place, key in enumerate(keys)}
    found, superseded, stale = {}, 0, 0
    for file in record_files(directory):
        for number, record in read_records(file):
            run = Run(record, directory, f"{file}:{number}")
            if places is not None and run.key not in places:
                stale += 1
                continue
            superseded += identity(run) in found
            found[identity(run)] = run
    if stale:
        warnings.warn(f"{directory}: {stale} stale records, not of the plan, are left out",
                      stacklevel=2)
    runs = list(found.values())
    missing = 0
    if places is not None:
        runs.sort(key=lambda run: places[run.key])
        missing = len(keys) - len({run.key for run in runs})
    return Runs((run for run in runs if run.applicable),
                not_applicable=(run for run in runs if not run.applicable),
                superseded=superseded, stale=stale, missing=missing)
