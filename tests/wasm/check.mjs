// Calls the functions in WebAssembly, and holds their results against the results of the machine
// itself: node check.mjs MODULE.wasm "$(native)"
import { readFileSync } from "node:fs";

const [path, native] = process.argv.slice(2);
const expected = native.trim().split(" ").map(Number);
const module = await WebAssembly.compile(readFileSync(path));

// A reader of archives imports a source of random numbers for passwords, which is never called.
const imports = {};
for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    imports[from] ??= {};
    imports[from][name] = () => {
        throw new Error(`${from}.${name} was called`);
    };
}
const instance = await WebAssembly.instantiate(module, imports);
const { fitted_rigidity, lowest_height } = instance.exports;
const results = [fitted_rigidity(), lowest_height(40)];

// The exponentials of the two targets differ in their last bits. A fit ends at the same minimum,
// and a simulation goes on within the accuracy of its steps.
const TOLERANCES = [1e-12, 1e-6];
results.forEach((result, index) => {
    const difference = Math.abs(result / expected[index] - 1);
    console.log(`${result} (WebAssembly), ${expected[index]} (machine)`);
    if (!(difference <= TOLERANCES[index])) {
        console.error(`they differ by ${difference} of their size`);
        process.exit(1);
    }
});
