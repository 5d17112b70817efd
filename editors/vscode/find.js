// Which mudline serves a workspace: that of the settings, of the selected interpreter, of .venv, or the one on the path.
"use strict";

const fs = require("node:fs");
const path = require("node:path");

const NAMES = process.platform === "win32" ? ["mudline.exe"] : ["mudline"];
const FOLDERS = process.platform === "win32" ? ["Scripts", ""] : ["bin", ""];

/** mudline in an environment: in its folder of programs. */
function inEnvironment(root) {
  const places = FOLDERS.flatMap((folder) => NAMES.map((name) => path.join(root, folder, name)));
  return places.find((place) => fs.existsSync(place));
}

/** mudline beside an interpreter, or in the environment of which the path is given instead. */
function besideInterpreter(given) {
  if (!given) {
    return undefined;
  }
  const folder = path.dirname(given);
  return NAMES.map((name) => path.join(folder, name)).find((place) => fs.existsSync(place)) ?? inEnvironment(folder) ?? inEnvironment(given);
}

/** The command, without arguments, and where it was found. */
function find(configured, interpreter, folders) {
  if (configured.length) {
    return { command: configured, source: "mudline.command" };
  }
  const selected = besideInterpreter(interpreter);
  if (selected) {
    return { command: [selected], source: "the selected interpreter" };
  }
  for (const folder of folders) {
    const own = inEnvironment(path.join(folder, ".venv"));
    if (own) {
      return { command: [own], source: ".venv" };
    }
  }
  return { command: ["mudline"], source: "PATH" };
}

module.exports = { find };
