// Fills the template with data as bqsa-bench does: `<` becomes \u003c, so that no text can end the element.
//   node tests/fill.mjs DATA.json OUT.html [TEMPLATE]
import { readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const kMark = "@BQSA_REPORT_DATA@";

export function fill(json, template) {
  const parts = template.split(kMark);
  if (parts.length !== 2) throw new Error(`the template has ${parts.length - 1} marks ${kMark}, expected 1`);
  const safe = json.replaceAll("<", "\\u003c").replaceAll("\u2028", "\\u2028").replaceAll("\u2029", "\\u2029");
  return parts[0] + safe + parts[1];
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [data, out, template] = process.argv.slice(2);
  if (!data || !out) throw new Error("usage: fill.mjs DATA.json OUT.html [TEMPLATE]");
  const path = template ?? fileURLToPath(new URL("../dist/template.html", import.meta.url));
  writeFileSync(out, fill(readFileSync(data, "utf8"), readFileSync(path, "utf8")));
}
