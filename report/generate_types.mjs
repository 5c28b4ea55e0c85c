// Writes src/report-data.d.ts from the schema of the report's data; with an argument, to that file.
import { writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { compileFromFile } from "json-schema-to-typescript";

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const types = await compileFromFile(here("bqsa-report-1.schema.json"), {
  bannerComment: "// Made from bqsa-report-1.schema.json by generate_types.mjs (npm run types); do not edit.",
  additionalProperties: false,
  strictIndexSignatures: true,
  style: { printWidth: 120 },
});
writeFileSync(process.argv[2] ?? here("src/report-data.d.ts"), types);
