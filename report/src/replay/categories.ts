// The five categories of the paper's Fig. 3 in words. Their colours are in palette.ts; a link in contact bears a cross
// as well.

export interface CategoryWords {
  name: string; ///< as the program and its figures call it
  meaning: string;
}

const kWords: readonly CategoryWords[] = [
  { name: "no collision 1", meaning: "the link's line misses the obstacle" },
  { name: "no collision 2", meaning: "the line enters it, beyond the link's ends" },
  { name: "crossing", meaning: "the link goes in and out again" },
  { name: "one end inside", meaning: "the link ends in the obstacle" },
  { name: "contained", meaning: "the whole link is inside" },
];

export const kCategories: readonly number[] = [1, 2, 3, 4, 5];

/** Words for a category; any number but 1 to 5 means that there is no obstacle. */
export function category_words(category: number): CategoryWords {
  return kWords[category - 1] ?? { name: "no obstacle", meaning: "there is nothing to hit" };
}

/** Categories 3, 4 and 5: the link's line is in the obstacle. */
export const is_hit = (category: number): boolean => category >= 3 && category <= 5;
