// Pages in a real browser: where they come from, and what goes wrong in them.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { fill } from "./fill.mjs";

export const kTemplate = fileURLToPath(new URL("../dist/template.html", import.meta.url));

/** A page that the program made; see make_reports.sh. */
export function page_file(name) {
  const folder = process.env.BQSA_REPORT_PAGES;
  if (!folder) throw new Error("BQSA_REPORT_PAGES: expected the directory that make_reports.sh wrote, got nothing");
  return join(folder, name, "report.html");
}

/** The data in a page. */
export function data_of(file) {
  const match = /<script type="application\/json" id="report-data">([\s\S]*?)<\/script>/.exec(
    readFileSync(file, "utf8"),
  );
  if (!match) throw new Error(`${file}: no data in it`);
  return JSON.parse(match[1]);
}

/** Starts a browser; `close` ends it and removes its pages. */
export async function start_browser() {
  const folder = mkdtempSync(join(tmpdir(), "bqsa-report-"));
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: [
      "--no-sandbox",
      "--disable-gpu",
      "--enable-unsafe-swiftshader",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
    ],
  });
  let pages = 0;

  /** Writes a page of data to a file of its own. */
  const write = (data) => {
    const file = join(folder, `${++pages}.html`);
    writeFileSync(file, fill(JSON.stringify(data), readFileSync(kTemplate, "utf8")));
    return file;
  };

  /** Opens a file at a fragment. `problems` gathers errors, requests, broken policies and dialogs. */
  const open = async (file, fragment = "", options = {}) => {
    const context = await browser.newContext({ viewport: { width: 1366, height: 768 }, ...options });
    const page = await context.newPage();
    const problems = [];
    page.on("pageerror", (error) => problems.push(String(error)));
    page.on("console", (message) => ["error", "warning"].includes(message.type()) && problems.push(message.text()));
    page.on(
      "request",
      (request) => /^(file|data|blob):/.test(request.url()) || problems.push(`request of ${request.url()}`),
    );
    page.on("dialog", (dialog) => {
      problems.push(`dialog: ${dialog.message()}`);
      void dialog.dismiss();
    });
    await page.addInitScript(() => {
      window.violations = [];
      document.addEventListener("securitypolicyviolation", (event) =>
        window.violations.push(`${event.violatedDirective} ${event.blockedURI}`),
      );
    });
    await page.goto(pathToFileURL(file).href + fragment);
    await page.waitForSelector("#view > *, .problem");
    const check = async () => [...problems, ...(await page.evaluate(() => window.violations))];
    return { page, problems: check, close: () => context.close() };
  };

  return {
    write,
    open,
    async close() {
      await browser.close();
      rmSync(folder, { recursive: true });
    },
  };
}
