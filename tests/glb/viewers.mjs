// GLB files in the Khronos validator, and drawn by three.js and <model-viewer> in a headless browser.
//
//     node viewers.mjs TOOLS BROWSER FILE.glb…
//
// The browser gets its files from a server in this process, so no other address is asked.

import { spawn } from "node:child_process";
import { createServer } from "node:http";
import { readFile, stat } from "node:fs/promises";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [tools, browser, ...files] = process.argv.slice(2);
const modules = join(resolve(tools), "node_modules");
const validator = createRequire(join(modules, "x.js"))("gltf-validator");

const IMPORTS = { three: "/npm/three/build/three.module.js", "three/addons/": "/npm/three/examples/jsm/" };

// A page tells the server what it saw: how much of the picture is drawn, or what went wrong.
const DRAWN = `
  const tell = (words) => fetch("/said", { method: "POST", body: words });
  window.onerror = (message) => tell("error: " + message);
  const share = (gl, width, height) => {
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let count = 0;
    for (let i = 3; i < pixels.length; i += 4) count += pixels[i] > 128;
    return count / (width * height);
  };`;

const THREE_PAGE = (file) => `
  import * as THREE from "three";
  import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
  import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";
  ${DRAWN}
  new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).load("${file}", ({ scene }) => {
    const renderer = new THREE.WebGLRenderer({ alpha: true, preserveDrawingBuffer: true });
    renderer.setSize(300, 400);
    const box = new THREE.Box3().setFromObject(scene), size = box.getSize(new THREE.Vector3());
    const middle = box.getCenter(new THREE.Vector3()), half = 0.6 * Math.max(size.y, (size.x * 4) / 3);
    const camera = new THREE.OrthographicCamera(-0.75 * half, 0.75 * half, half, -half, 0.01, 10);
    camera.position.copy(middle).add(new THREE.Vector3(0, 0, 5));
    const all = new THREE.Scene().add(scene, new THREE.HemisphereLight(0xffffff, 0x888888, 3));
    renderer.render(all, camera);
    const mm = size.toArray().map((x) => Math.round(1000 * x)).join(" x ");
    tell(mm + " mm, " + share(renderer.getContext(), 300, 400).toFixed(3));
  }, undefined, (problem) => tell("error: " + problem));`;

const ELEMENT_PAGE = (file) => `
  import { ModelViewerElement } from "/npm/@google/model-viewer/dist/model-viewer.min.js";
  ModelViewerElement.meshoptDecoderLocation = "/npm/meshoptimizer/meshopt_decoder.cjs";
  ${DRAWN}
  const view = document.createElement("model-viewer");
  view.style = "width:300px;height:400px";
  view.addEventListener("error", (e) => tell("error: " + JSON.stringify(e.detail)));
  view.addEventListener("load", () => {
    const { x, y, z } = view.getDimensions();
    const materials = view.model.materials.length, variants = view.availableVariants.length;
    tell([x, y, z].map((v) => Math.round(1000 * v)).join(" x ") + " mm, " + materials + " materials, " + variants + " variants");
  });
  view.src = "${file}";
  document.body.append(view);`;

const page = (script) => `<!DOCTYPE html><title>GLB</title><script type="importmap">${JSON.stringify({ imports: IMPORTS })}</script>
<body><script type="module">${script}</script></body>`;

// So long a page may take, milliseconds.
const PATIENCE = 120_000;

const TYPES = { html: "text/html", js: "text/javascript", glb: "model/gltf-binary" };

// Who waits for what a page tells.
let heard = () => {};

async function answer(request, response) {
  if (request.method === "POST") {
    let text = "";
    for await (const part of request) text += part;
    response.writeHead(204).end();
    return heard(text);
  }
  const [, kind, rest] = /^\/([^/]*)\/(.*)$/.exec(request.url) || [];
  try {
    let body = null;
    if (kind === "npm") body = await readFile(join(modules, rest));
    if (kind === "glb") body = await readFile(files[Number.parseInt(rest, 10)]);
    if (kind === "three") body = page(THREE_PAGE(`/glb/${rest}.glb`));
    if (kind === "element") body = page(ELEMENT_PAGE(`/glb/${rest}.glb`));
    if (body === null) throw new Error("unknown");
    const ending = kind === "glb" ? "glb" : kind === "npm" ? "js" : "html";
    response.writeHead(200, { "content-type": TYPES[ending] }).end(body);
  } catch {
    response.writeHead(404).end();
  }
}

// Opens a page, and waits for what it tells.
function open(url) {
  const more = ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
  return new Promise((done) => {
    const child = spawn(browser, [...more, "--remote-debugging-port=0", url], { stdio: "ignore" });
    const late = setTimeout(() => heard("error: nothing was drawn"), PATIENCE);
    heard = (text) => {
      clearTimeout(late);
      child.on("close", () => done(text));
      child.kill();
    };
  });
}

const server = createServer(answer);
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const origin = `http://127.0.0.1:${server.address().port}`;
let failed = false;
for (const [k, file] of files.entries()) {
  const bytes = new Uint8Array(await readFile(file));
  const { numErrors, numWarnings } = (await validator.validateBytes(bytes)).issues;
  const three = await open(`${origin}/three/${k}`), element = await open(`${origin}/element/${k}`);
  const drawn = Number(three.split(", ")[1]);
  const good = numErrors + numWarnings === 0 && drawn > 0.05 && !element.startsWith("error");
  failed ||= !good;
  const size = ((await stat(file)).size / 1000).toFixed(0);
  console.log(`${file}: ${size} kB; ${numErrors} errors, ${numWarnings} warnings; three.js: ${three}; model-viewer: ${element}; ${good ? "good" : "BAD"}`);
}
server.close();
process.exitCode = failed ? 1 : 0;
