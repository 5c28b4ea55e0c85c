// Numbers with units, for people. Null is a dash: there is no such number. And their median.

export const kNone = "–";

/** Three significant digits, in powers of ten outside 0.001 ... 99,999; smaller whole numbers in full. */
export function number(value: number | null | undefined, digits = 3): string {
  if (value === null || value === undefined || Number.isNaN(value)) return kNone;
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (Number.isInteger(value) && size < 1e7) return `${value < 0 ? "−" : ""}${count(size)}`;
  if (size < 1e-3 || size >= 99_999.5) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e") as [string, string];
    return minus(`${mantissa}·${power_of_ten(Number(exponent))}`);
  }
  const rounded = Number(value.toPrecision(digits));
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(rounded))));
  return minus(rounded.toFixed(decimals));
}

function minus(text: string): string {
  return text.replace(/^-/, "−");
}

const kSuperscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** 10 to a whole power, written with superscripts. */
export function power_of_ten(exponent: number): string {
  const digits = String(Math.abs(exponent)).replace(/\d/g, (d) => kSuperscripts[Number(d)] ?? d);
  return `10${exponent < 0 ? "⁻" : ""}${digits}`;
}

/** Label of a logarithmic axis: 10^k, nothing between. */
export function decade(value: number): string {
  const exponent = Math.log10(value);
  const whole = Math.round(exponent);
  if (Math.abs(exponent - whole) > 1e-9) return "";
  return whole === 0 ? "1" : whole === 1 ? "10" : power_of_ten(whole);
}

interface Scaled {
  unit: string;
  factor: number;
}

function scaled(value: number, units: readonly [number, string][]): Scaled {
  for (const [scale, unit] of units) {
    if (Math.abs(value) >= scale * 0.9995) return { unit, factor: 1 / scale };
  }
  const [scale, unit] = units[units.length - 1] as [number, string];
  return { unit, factor: 1 / scale };
}

const kTimes: [number, string][] = [
  [60, "min"],
  [1, "s"],
  [1e-3, "ms"],
  [1e-6, "µs"],
  [1e-9, "ns"],
];
const kLengths: [number, string][] = [
  [1, "m"],
  [1e-3, "mm"],
  [1e-6, "µm"],
  [1e-9, "nm"],
];

function with_unit(value: number | null | undefined, units: readonly [number, string][], digits: number): string {
  if (value === null || value === undefined || Number.isNaN(value)) return kNone;
  const { unit, factor } = scaled(value === 0 ? (units[1]?.[0] ?? 1) : value, units);
  return `${number(value * factor, digits)} ${unit}`;
}

/** A time given in seconds, in the unit that suits it. */
export const time = (seconds: number | null | undefined, digits = 3): string => with_unit(seconds, kTimes, digits);

/** A length given in metres, in the unit that suits it. */
export const length = (metres: number | null | undefined, digits = 3): string => with_unit(metres, kLengths, digits);

/** A length in millimetres throughout, for columns. */
export const millimetres = (metres: number | null | undefined): string =>
  metres === null || metres === undefined ? kNone : number(metres * 1e3);

/** A time in microseconds throughout, for columns. */
export const microseconds = (seconds: number | null | undefined): string =>
  seconds === null || seconds === undefined ? kNone : number(seconds * 1e6);

/** An angle given in radians, in degrees. */
export const degrees = (radians: number | null | undefined): string =>
  radians === null || radians === undefined ? kNone : `${number((radians * 180) / Math.PI)}°`;

/** A share as a percentage. */
export function percent(share: number | null | undefined): string {
  if (share === null || share === undefined) return kNone;
  return `${(share * 100).toFixed(share > 0 && share < 1 ? 1 : 0)} %`;
}

/** A whole number with thin spaces between thousands, from 10,000 on. */
export function count(value: number): string {
  return value < 1e4 ? String(value) : String(value).replace(/\B(?=(\d{3})+(?!\d))/g, "\u202f");
}

/** "1 run", "2 runs". */
export function counted(value: number, one: string, many = `${one}s`): string {
  return `${count(value)} ${value === 1 ? one : many}`;
}

/** An interval, "[1.2, 1.3]"; empty where there is none. */
export function interval(
  lower: number | null | undefined,
  upper: number | null | undefined,
  text: (value: number) => string = number,
): string {
  if ((lower ?? null) === null && (upper ?? null) === null) return "";
  return `[${lower === null || lower === undefined ? "−∞" : text(lower)}, ${upper === null || upper === undefined ? "∞" : text(upper)}]`;
}

/** An ISO date, to the minute. */
export function date(text: string): string {
  const match = /^(\d{4}-\d\d-\d\d)T(\d\d:\d\d)/.exec(text);
  return match ? `${match[1]} ${match[2]} UTC` : text;
}

/** The middle one of the values, or the mean of the two in the middle; null without values. */
export function median(values: readonly number[]): number | null {
  const ordered = [...values].sort((a, b) => a - b);
  const middle = Math.floor(ordered.length / 2);
  const upper = ordered[middle];
  if (upper === undefined) return null;
  return ordered.length % 2 === 1 ? upper : (upper + (ordered[middle - 1] as number)) / 2;
}
