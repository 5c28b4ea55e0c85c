// Names that tell entries apart, where files edited and run again have given the same name twice.

/** Entries by their names, or where several have one, by longer ones that are nobody's name. */
export class UniqueNames {
  readonly #unique: string[];
  readonly #places = new Map<string, number>();

  /** `longer`: what an entry is called whose name repeats; the `nth` of that name, from 1 on. */
  constructor(names: readonly string[], longer: (index: number, nth: number) => string) {
    const times = new Map<string, number>();
    names.forEach((name, index) => {
      this.#places.set(name, index);
      times.set(name, (times.get(name) ?? 0) + 1);
    });
    const met = new Map<string, number>();
    this.#unique = names.map((name, index) => {
      if (times.get(name) === 1) return name;
      const nth = (met.get(name) ?? 0) + 1;
      met.set(name, nth);
      let unique = longer(index, nth);
      for (let next = 2; this.#places.has(unique); ++next) unique = `${longer(index, nth)}~${next}`;
      this.#places.set(unique, index);
      return unique;
    });
  }

  /** Unique name of an entry; empty if there is no such entry. */
  of(index: number): string {
    return this.#unique[index] ?? "";
  }

  /** Index of the entry of a unique name, or the last one of a name; -1 if there is none. */
  index(name: string): number {
    return this.#places.get(name) ?? -1;
  }
}
