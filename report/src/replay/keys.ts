// The keyboard of a replay.

export type KeyAction =
  | { do: "toggle" | "loop" | "ghosts" | "reset" }
  | { do: "step"; ticks: number }
  | { do: "seek"; end: boolean }
  | { do: "speed" | "moment"; by: 1 | -1 }
  | { do: "zoom"; factor: number };

/** Every key, for the help. */
export const kKeyHelp: readonly (readonly [keys: string, what: string])[] = [
  ["space", "play, pause"],
  ["← →", "a tick"],
  ["shift ← →", "10 ticks"],
  ["home end", "first, last tick"],
  ["[ ]", "slower, faster"],
  ["j k", "next, previous moment"],
  ["l", "loop"],
  ["g", "ghosts"],
  ["+ − 0", "zoom, whole scene"],
];

/** What a key asks for; null if it is none of the replay's. */
export function key_action(
  event: Pick<KeyboardEvent, "key" | "shiftKey" | "ctrlKey" | "altKey" | "metaKey">,
): KeyAction | null {
  if (event.ctrlKey || event.altKey || event.metaKey) return null;
  switch (event.key) {
    case " ":
      return { do: "toggle" };
    case "ArrowLeft":
      return { do: "step", ticks: event.shiftKey ? -10 : -1 };
    case "ArrowRight":
      return { do: "step", ticks: event.shiftKey ? 10 : 1 };
    case "Home":
      return { do: "seek", end: false };
    case "End":
      return { do: "seek", end: true };
    case "[":
      return { do: "speed", by: -1 };
    case "]":
      return { do: "speed", by: 1 };
    case "j":
      return { do: "moment", by: 1 };
    case "k":
      return { do: "moment", by: -1 };
    case "l":
      return { do: "loop" };
    case "g":
      return { do: "ghosts" };
    case "+":
      return { do: "zoom", factor: 1.25 };
    case "-":
      return { do: "zoom", factor: 0.8 };
    case "0":
      return { do: "reset" };
    default:
      return null;
  }
}

/** Whether the element that has the focus needs the key itself. The scrubber leaves all keys to the replay. */
export function keeps_key(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof Element)) return false;
  if (target.matches('input[type="range"]')) return false;
  if (target.closest("input, select, textarea, [contenteditable]")) return true;
  return key === " " && target.closest("button, summary, a") !== null;
}
