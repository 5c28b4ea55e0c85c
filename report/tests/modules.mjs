// Modules of the page for tests of their own.
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

// What the palette asks of a browser as it is loaded.
globalThis.matchMedia ??= () => ({ matches: false, addEventListener: () => {} });
globalThis.document ??= { documentElement: { dataset: {} } };

/** A TypeScript module under src, bundled; for what draws nothing. */
export async function module_of(name) {
  const path = fileURLToPath(new URL(`../src/${name}.ts`, import.meta.url));
  const { outputFiles } = await build({
    entryPoints: [path],
    bundle: true,
    write: false,
    format: "esm",
    target: "es2021",
  });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);
}
