// Colours after Okabe and Ito, told apart by people who see few colours, with dashes and symbols for the rest.

export interface SeriesStyle {
  color: string;
  dash: number[]; ///< lengths of strokes and gaps [px]; empty: solid
  symbol: "circle" | "rect" | "triangle" | "diamond" | "roundRect" | "pin" | "arrow";
}

const kLightColors = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#B07C00", "#3A9BD9", "#666666"];
const kDarkColors = ["#56B4E9", "#FF8A3D", "#2FC79A", "#E39AC4", "#E69F00", "#9AD0F5", "#B5B5B5"];
const kDashes: number[][] = [[], [7, 4], [2, 3], [9, 3, 2, 3]];
const kSymbols: SeriesStyle["symbol"][] = ["circle", "rect", "triangle", "diamond", "roundRect"];

/** Look of the i-th method or series, the same in all charts. */
export function series_style(index: number, dark: boolean): SeriesStyle {
  const colors = dark ? kDarkColors : kLightColors;
  return {
    color: colors[index % colors.length] as string,
    dash: kDashes[Math.floor(index / colors.length) % kDashes.length] as number[],
    symbol: kSymbols[index % kSymbols.length] as SeriesStyle["symbol"],
  };
}

/** Colours of the categories 1 to 5 of the quadratic, light and dark; 1 and 2 are free. */
const kCategoriesLight = ["#56B4E9", "#0072B2", "#E69F00", "#D55E00", "#A0206A"];
const kCategoriesDark = ["#8FCBF2", "#3D9BE0", "#F0B429", "#FF7A33", "#E66BB0"];

export function category_color(category: number, dark: boolean): string {
  return (dark ? kCategoriesDark : kCategoriesLight)[category - 1] ?? (dark ? "#9a9a9a" : "#777777");
}

/** Colours of charts apart from the series. */
export interface Theme {
  dark: boolean;
  text: string;
  muted: string;
  line: string;
  background: string;
  bad: string;
  good: string;
  solid: string; ///< obstacles as they are
  ellipsoid: string;
}

export const kLightTheme: Theme = {
  dark: false,
  text: "#1d2227",
  muted: "#5b6570",
  line: "#dfe3e8",
  background: "#ffffff",
  bad: "#b3261e",
  good: "#006b4f",
  solid: "#b98b4e",
  ellipsoid: "#6d7a8c",
};

export const kDarkTheme: Theme = {
  dark: true,
  text: "#e6e9ec",
  muted: "#9aa4ae",
  line: "#333b44",
  background: "#171b20",
  bad: "#ff8a80",
  good: "#5fd3a8",
  solid: "#c9a26b",
  ellipsoid: "#a8b4c4",
};

const kListeners = new Set<() => void>();
const kDark = matchMedia("(prefers-color-scheme: dark)");
const kPrint = matchMedia("print");
let chosen: "light" | "dark" | null = null;

/** Whether the page is dark: as chosen, else as the system is; on paper never. */
export function is_dark(): boolean {
  if (kPrint.matches) return false;
  return chosen === null ? kDark.matches : chosen === "dark";
}

export const theme = (): Theme => (is_dark() ? kDarkTheme : kLightTheme);

/** Calls a function when light changes to dark or back; returns what ends that. */
export function on_theme(listener: () => void): () => void {
  kListeners.add(listener);
  return () => kListeners.delete(listener);
}

/** Chooses light or dark, whatever the system is. */
export function choose_theme(name: "light" | "dark"): void {
  chosen = name;
  apply();
}

function apply(): void {
  document.documentElement.dataset["theme"] = is_dark() ? "dark" : "light";
  for (const listener of kListeners) listener();
}

for (const media of [kDark, kPrint]) media.addEventListener("change", apply);
apply();
