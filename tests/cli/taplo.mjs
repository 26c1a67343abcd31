// SPDX-License-Identifier: BSD-3-Clause
// What an editor would show: Taplo's language server, as "Even Better TOML" has it, without network.
//     node taplo.mjs MODULES ROOT FILE LINE:COLUMN...
// Opens the text of standard input as FILE below ROOT and prints one JSON document: its
// diagnostics, and completions and hover at each place (lines and columns from 0).
import { createRequire } from "module";
import fs from "fs";
import path from "path";
import { pathToFileURL } from "url";

const [modules, root, file, ...places] = process.argv.slice(2);
const { TaploLsp } = createRequire(modules + "/")("@taplo/lsp");
const environment = {
  now: () => new Date(),
  envVar: () => undefined,
  envVars: () => [],
  stdErrAtty: () => false,
  stdin: process.stdin,
  stdout: process.stderr,
  stderr: process.stderr,
  glob: () => [],
  readFile: (name) => fs.promises.readFile(name),
  writeFile: async () => {},
  urlToFilePath: (url) => decodeURI(url).slice("file://".length),
  isAbsolute: (name) => path.isAbsolute(name),
  cwd: () => root,
  findConfigFile: () => {
    const name = path.join(root, ".taplo.toml");
    return fs.existsSync(name) ? name : undefined;
  },
  fetch: { fetch: async () => { throw new Error("no network"); }, Headers, Request, Response },
};

const answers = new Map();
let diagnostics = [], configured;
const isConfigured = new Promise((resolve) => { configured = resolve; });

function receive(message) {
  if (message.method === "workspace/configuration") {
    const result = message.params.items.map(() => ({ schema: { enabled: true, catalogs: [] } }));
    setTimeout(() => { lsp.send({ jsonrpc: "2.0", id: message.id, result }); configured(); }, 0);
  } else if (message.method === "textDocument/publishDiagnostics") {
    diagnostics = message.params.diagnostics;
  } else if (answers.has(message.id)) {
    answers.get(message.id)(message.result);
  }
}

const lsp = await TaploLsp.initialize(environment, { onMessage: receive });
let asked = 0;
function ask(method, params) {
  return new Promise((resolve) => {
    answers.set(++asked, resolve);
    lsp.send({ jsonrpc: "2.0", id: asked, method, params });
  });
}
const tell = (method, params) => lsp.send({ jsonrpc: "2.0", method, params });
const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

const uri = pathToFileURL(path.join(root, file)).href;
const folder = { uri: pathToFileURL(root).href, name: "rondo" };
const markdown = { textDocument: { completion: { completionItem: { documentationFormat: ["markdown"] } } } };
await ask("initialize", { processId: null, rootUri: folder.uri, workspaceFolders: [folder],
                          capabilities: markdown });
tell("initialized", {});
await Promise.race([isConfigured, sleep(5000)]);
const text = fs.readFileSync(0, "utf8");
tell("textDocument/didOpen", { textDocument: { uri, languageId: "toml", version: 1, text } });
for (let k = 0; k < 100 && diagnostics.length === 0; ++k) await sleep(50);

const found = [];
for (const place of places) {
  const [line, character] = place.split(":").map(Number);
  const at = { textDocument: { uri }, position: { line, character } };
  const completions = await ask("textDocument/completion", at);
  const hover = await ask("textDocument/hover", at);
  found.push({ completions: completions?.items ?? completions ?? [], hover: hover?.contents?.value ?? "" });
}
// A pipe takes what is longer than its buffer only bit by bit.
process.stdout.write(JSON.stringify({ diagnostics, found }), () => process.exit(0));
