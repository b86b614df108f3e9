// Lists the functions of the module named on the command line by their size in bytes, the largest first.
import { readFile } from "node:fs/promises";

const bytes = await readFile(process.argv[2]);
let at = 8;

function number() {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
        const byte = bytes[at++];
        value += (byte & 0x7f) * 2 ** shift;
        if (byte < 0x80) return value;
    }
}

function text() {
    const length = number();
    at += length;
    return bytes.toString("utf8", at - length, at);
}

// A name in the words of the source: `_ZN`, each part after its length, the last of them a hash.
function demangled(name) {
    const parts = [];
    for (let rest = name.slice(3); /^[0-9]/.test(rest); ) {
        const length = parseInt(rest);
        const start = String(length).length;
        parts.push(rest.slice(start, start + length));
        rest = rest.slice(start + length);
    }
    if (!name.startsWith("_ZN") || parts.length < 2) return name;
    const escapes = { LT: "<", GT: ">", u20: " ", u7b: "{", u7d: "}", C: ",", RF: "&", LP: "(", RP: ")", BP: "*" };
    const unescaped = (part) =>
        part.replace(/^_\$/, "$").replace(/\$(\w+)\$/g, (all, code) => escapes[code] ?? all).replaceAll("..", "::");
    return parts.slice(0, -1).map(unescaped).join("::");
}

const sizes = [];
const names = new Map();
let imports = 0;
while (at < bytes.length) {
    const section = bytes[at++];
    const end = number() + at;
    if (section === 2) {
        // Only functions are imported.
        imports = number();
    } else if (section === 10) {
        for (let count = number(); count > 0; count--) {
            const size = number();
            sizes.push(size);
            at += size;
        }
    } else if (section === 0 && text() === "name") {
        while (at < end) {
            const kind = bytes[at++];
            const subsectionEnd = number() + at;
            for (let count = kind === 1 ? number() : 0; count > 0; count--) names.set(number(), text());
            at = subsectionEnd;
        }
    }
    at = end;
}
const rows = sizes.map((size, index) => [size, names.get(imports + index) ?? "without a name"]);
rows.sort(([a], [b]) => b - a);
for (const [size, name] of rows) console.log(`${size} ${demangled(name)}`);
