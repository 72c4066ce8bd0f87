// Khronos' glTF-Validator: a line of JSON for each file of the jobs that the first argument names.
const fs = require("fs");
const validator = require("gltf-validator");

const SEVERITIES = ["error", "warning"];

async function read(path) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(path)), { uri: path });
  const bad = report.issues.messages.filter((issue) => issue.severity < SEVERITIES.length);
  return { errors: bad.map((issue) => `${issue.code} ${issue.pointer ?? ""}: ${issue.message}`) };
}

async function main() {
  for (const job of JSON.parse(fs.readFileSync(process.argv[2], "utf-8"))) {
    const start = performance.now();
    const reading = await read(job.path).catch((error) => ({ errors: [String(error)] }));
    const seconds = (performance.now() - start) / 1000;
    console.log(JSON.stringify({ asset: job.asset, seconds, ...reading }));
  }
}

main();
