// The Khronos validator on GLBs: nothing may be found, not even a hint. Usage: node validate_glb.cjs FILE...
// Exit code 77 (skipped) when gltf-validator is not installed; NODE_PATH says where it is.
const fs = require('fs');

let validator;
try {
  validator = require('gltf-validator');
} catch {
  console.log('skipped: gltf-validator is not installed (npm ci in the node folder of the build)');
  process.exit(77);
}

async function validate(path) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(path)), { maxIssues: 0 });
  const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
  console.log(`${path}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints`);
  for (const message of messages) console.log(`  ${message.code} at ${message.pointer}: ${message.message}`);
  return numErrors + numWarnings + numInfos + numHints;
}

(async () => {
  let found = 0;
  for (const path of process.argv.slice(2)) found += await validate(path);
  process.exit(found === 0 && process.argv.length > 2 ? 0 : 1);
})();
