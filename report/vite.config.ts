// Builds the template: one HTML file with everything inside it and a mark where the data go.
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { defineConfig, type Plugin } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

const kNotice = /licen[cs]e|notice/i;

/** The licence texts of a package, as it ships them. */
function notices_of(name: string): string {
  const folder = join("node_modules", name);
  const { version } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8")) as { version: string };
  const files = readdirSync(folder, { withFileTypes: true })
    .filter((entry) => kNotice.test(entry.name))
    .flatMap((entry) =>
      entry.isDirectory() ? readdirSync(join(folder, entry.name)).map((file) => join(entry.name, file)) : [entry.name],
    )
    .sort();
  if (files.length === 0) throw new Error(`${name}: no licence file in ${folder}`);
  const texts = files.map((file) => readFileSync(join(folder, file), "utf8").replaceAll("\r\n", "\n").trim());
  return [`${name} ${version}`, ...texts].join("\n\n");
}

/** The package a module belongs to, "" for our own. */
function package_of(module: string): string {
  const match = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(module.replaceAll("\\", "/"));
  const name = match?.[1] ?? "";
  return name !== "" && existsSync(join("node_modules", name, "package.json")) ? name : "";
}

/** Keeps the licences of all that is bundled, and makes the inlined module a plain script at the end of the body,
 *  which runs in order after the data. */
function finish(): Plugin {
  const packages = new Set<string>();
  return {
    name: "finish-template",
    enforce: "post",
    renderChunk(_code, chunk) {
      for (const module of Object.keys(chunk.modules)) packages.add(package_of(module));
      packages.delete("");
      return null;
    },
    generateBundle: {
      order: "post",
      handler(_options, bundle) {
        for (const asset of Object.values(bundle)) {
          if (asset.type !== "asset" || !asset.fileName.endsWith(".html")) continue;
          let html = String(asset.source);
          const script = /<script type="module"[^>]*>([\s\S]*?)<\/script>\s*/.exec(html);
          if (!script) throw new Error("no module script in the page");
          const notices = [...packages].sort().map(notices_of).join("\n\n\n");
          if (/<\/script|<!--/i.test(notices)) throw new Error("a licence text would end its element");
          html = html.replace(script[0], () => "");
          html = html.replace(
            "</body>",
            () =>
              `<script type="text/plain" id="licences">\n${notices}\n</script>\n` +
              `<script>${script[1]}</script>\n</body>`,
          );
          asset.source = html;
          asset.fileName = "template.html";
        }
      },
    },
  };
}

export default defineConfig({
  build: {
    emptyOutDir: false,
    target: "es2021",
    modulePreload: { polyfill: false },
    assetsInlineLimit: Number.MAX_SAFE_INTEGER,
    cssCodeSplit: false,
    reportCompressedSize: false,
    chunkSizeWarningLimit: 4000,
    rollupOptions: { output: { format: "iife", inlineDynamicImports: true } },
  },
  plugins: [viteSingleFile({ useRecommendedBuildConfig: false }), finish()],
});
