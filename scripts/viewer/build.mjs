// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Bundles the viewer and writes it as a C++ source (io/view/page.h):
//   node build.mjs NPM WORK_FOLDER VIEWER_PAGE.cpp
// Packages are installed from the lock file into the work folder. Where npm
// cannot have them (no network) the source says that there is no page.
import { execFileSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const [npm, work, target] = process.argv.slice(2);
const sources = dirname(fileURLToPath(import.meta.url));
// Compilers need to take no longer literals than this (C++ [implimits]).
const pieceLength = 60000;

function installPackages() {
  mkdirSync(work, { recursive: true });
  const lock = readFileSync(join(sources, "package-lock.json"), "utf8");
  const installed = join(work, "installed-lock.json");
  if (existsSync(installed) && readFileSync(installed, "utf8") === lock) return;
  for (const name of ["package.json", "package-lock.json"]) copyFileSync(join(sources, name), join(work, name));
  execFileSync(npm, ["ci", "--ignore-scripts", "--no-fund", "--no-audit", "--loglevel=error"],
    { cwd: work, stdio: ["ignore", "ignore", "pipe"], timeout: 300000 });
  writeFileSync(installed, lock);
}

function bundle() {
  const esbuild = createRequire(join(work, "package.json"))("esbuild");
  const made = esbuild.buildSync({
    entryPoints: [join(sources, "main.js")], bundle: true, minify: true, write: false, format: "iife",
    target: "es2020", nodePaths: [join(work, "node_modules")], charset: "ascii", legalComments: "inline",
  });
  return made.outputFiles[0].text;
}

function page() {
  const css = readFileSync(join(sources, "page.css"), "utf8");
  const html = readFileSync(join(sources, "page.html"), "utf8").replace("/* style */", () => css);
  const [head, tail] = html.split("<!-- data -->\n");
  // A script ends at the first "</script", also within its strings.
  const program = bundle().replaceAll("</script", "<\\/script");
  return [head, tail.replace("/* program */", () => program)];
}

function pieces(name, text) {
  const list = [];
  for (let k = 0; k < text.length; k += pieceLength)
    // With their length: to count it is more than Clang does of constants.
    list.push(`R"sunload~(${text.slice(k, k + pieceLength)})sunload~"sv`);
  const array = list.length ? `  static constexpr std::string_view pieces[] = {\n${list.join(",\n")}};\n  return pieces;` : "  return {};";
  return `std::span<const std::string_view> ${name}() {\n${array}\n}\n`;
}

let parts = ["", ""];
let why = "";
try {
  installPackages();
} catch (error) {
  why = `${error.stderr ?? ""}`.trim() || error.message;
}
if (why) console.error(`viewer: built without its page, because npm could not install its packages (to try again, remove ${target} and build):\n${why}`);
else parts = page();
mkdirSync(dirname(target), { recursive: true });
writeFileSync(target, `#include "io/view/page.h"\n\nnamespace sunload {\n\nusing namespace std::string_view_literals;\n\n${pieces("viewer_page_head", parts[0])}
${pieces("viewer_page_tail", parts[1])}\n}  // namespace sunload\n`);
