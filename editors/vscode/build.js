// Bundles the client with the libraries that it uses, collects the licences of these, and takes over that of mudline.
"use strict";

const fs = require("node:fs");
const path = require("node:path");
const esbuild = require("esbuild");

const OUT = path.join(__dirname, "dist");

const result = esbuild.buildSync({
  absWorkingDir: __dirname,
  entryPoints: ["extension.js"],
  bundle: true,
  platform: "node",
  target: "node20",
  external: ["vscode"],
  minify: true,
  outfile: "dist/extension.js",
  metafile: true,
  preserveSymlinks: true,
  logLevel: "warning",
});

const inputs = Object.keys(result.metafile.inputs);
const folders = new Set(inputs.map((file) => /^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1]).filter(Boolean));
const licences = [...folders].sort().map((folder) => {
  const about = JSON.parse(fs.readFileSync(path.join(__dirname, folder, "package.json"), "utf8"));
  const name = fs.readdirSync(path.join(__dirname, folder)).find((file) => /^licen[cs]e/i.test(file));
  if (!name) {
    throw new Error(`${folder} has no licence file: its terms are to be read before it is shipped`);
  }
  return `${about.name} ${about.version} (${about.license})\n\n${fs.readFileSync(path.join(__dirname, folder, name), "utf8")}`;
});
fs.copyFileSync(path.join(__dirname, "..", "..", "LICENSE"), path.join(__dirname, "LICENSE.txt"));
fs.writeFileSync(path.join(OUT, "LICENSES.txt"), licences.join(`\n${"-".repeat(78)}\n\n`));
