// node build.mjs NODE_MODULES OUTPUT: bundles the page. The libraries lie in the build folder, never beside the sources.
import { cpSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const page = dirname(fileURLToPath(import.meta.url));
const [modules, output] = process.argv.slice(2).map((path) => resolve(path));
const { build } = createRequire(join(modules, "here.js"))("esbuild");

mkdirSync(output, { recursive: true });
await build({
  entryPoints: [join(page, "src/main.js"), join(page, "src/style.css")],
  outdir: output,
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  nodePaths: [modules],
  legalComments: "none",
  logLevel: "warning",
});
for (const name of ["main.js", "style.css"]) {
  const file = join(output, name);
  writeFileSync(`${file}.gz`, gzipSync(readFileSync(file), { level: 9 }));
}
const licence = readFileSync(join(modules, "three/LICENSE"), "utf8");
writeFileSync(join(output, "licences.txt"), `This page contains three.js (https://threejs.org).\n\n${licence}`);
// Last: it tells the build that all is there.
cpSync(join(page, "static"), output, { recursive: true });
