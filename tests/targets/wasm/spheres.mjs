// Times the module named on the command line: of each way to the nearest of many spheres the median, all ways in turn.
import { readFile } from "node:fs/promises";

// Many short rounds: in a long one, the processor is shared.
const ROUNDS = 201;
const RAYS = 256;

const { instance } = await WebAssembly.instantiate(await readFile(process.argv[2]));
const { place, by_formula, by_slice, by_spheres } = instance.exports;
const ways = [by_formula, by_slice, by_spheres];

function time(run) {
    const before = performance.now();
    run();
    return performance.now() - before;
}

for (const count of [8, 46, 1024]) {
    place(count);
    if (by_slice() !== by_spheres()) throw new Error("`Spheres` differs from the slice");
    // Repeated so that the clock's resolution is small beside it.
    const repeats = Math.ceil(1024 / count);
    const times = ways.map(() => []);
    for (let round = 0; round < ROUNDS; round++) {
        ways.forEach((way, i) => {
            times[i].push(time(() => { for (let i = 0; i < repeats; i++) way(); }));
        });
    }
    const medians = times.map((list) => list.sort((a, b) => a - b)[ROUNDS >> 1] * 1e6 / (repeats * RAYS));
    const [formula, slice, spheres] = medians;
    const times_the_formula = (time) => (time / formula).toFixed(2);
    console.log(
        `  ${count} spheres: ${spheres.toFixed(0)} ns a ray by Spheres, ${times_the_formula(spheres)} times the formula's ` +
            `${formula.toFixed(0)}; ${times_the_formula(slice)} times by nearest of a slice`,
    );
}
