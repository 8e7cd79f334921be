// node build.mjs NODE_MODULES OUTPUT: bundles the page. The libraries lie in the build folder, never beside the sources.
import { cpSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const page = dirname(fileURLToPath(import.meta.url));
const [modules, output] = process.argv.slice(2).map((path) => resolve(path));
const { build } = createRequire(join(modules, "here.js"))("esbuild");

mkdirSync(output, { recursive: true });
// Parts of an earlier bundle have other names.
for (const name of readdirSync(output)) if (/\.(js|css)(\.gz)?$/.test(name)) rmSync(join(output, name));
const { metafile } = await build({
  metafile: true,
  entryPoints: ["main.js", "style.css", "view/graphics_worker.js"].map((file) => join(page, "src", file)),
  entryNames: "[name]",
  outdir: output,
  bundle: true,
  splitting: true, // the view in three dimensions is loaded when it is wanted
  minify: true,
  format: "esm",
  target: "es2022",
  nodePaths: [modules],
  legalComments: "none",
  logLevel: "warning",
});
for (const name of readdirSync(output).filter((file) => /\.(js|css)$/.test(file))) {
  const file = join(output, name);
  writeFileSync(`${file}.gz`, gzipSync(readFileSync(file), { level: 9 }));
}
const licence = readFileSync(join(modules, "three/LICENSE"), "utf8");
writeFileSync(join(output, "licences.txt"), `This page contains three.js (https://threejs.org).\n\n${licence}`);
cpSync(join(page, "static"), output, { recursive: true });
// What main.js imports at once is asked for together with it. Last: this file tells the build that all is there.
const [, main] = Object.entries(metafile.outputs).find(([file]) => file.endsWith("main.js"));
const parts = main.imports.filter(({ kind }) => kind === "import-statement").map(({ path }) => basename(path));
const links = parts.map((part) => `<link rel="modulepreload" href="${part}" />`).join("\n    ");
const html = readFileSync(join(page, "static/index.html"), "utf8");
writeFileSync(join(output, "index.html"), html.replace("<script", () => `${links}\n    <script`));
