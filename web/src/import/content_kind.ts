// What a file holds, told from its first bytes: the same list as src/wilt/import/content_kind.cpp, with what a page can
// do about each.

export type ContentKind = "photo" | "glb" | "gltf" | "ply" | "stl" | "obj" | "outline" | "svg";

interface Known {
  begin: string; // the file's first bytes, behind blanks and comments
  word?: string; // that stands in its first kilobytes too
  name: string;
  kind?: ContentKind; // none: no leaf file
  advice?: string; // for one that is none
}

const EXPORT_PICTURE = "export it as PNG or JPEG";
const EXPORT_MESH = "export it as .glb or .obj";
const SAVE_FILE = "save the file itself, not the page that shows it";

const KNOWN: Known[] = [
  { begin: "\x89PNG", name: "a PNG picture", kind: "photo" },
  { begin: "\xff\xd8\xff", name: "a JPEG picture", kind: "photo" },
  { begin: "glTF", name: "a binary glTF", kind: "glb" },
  { begin: "ply", word: "format ", name: "a PLY mesh", kind: "ply" },
  { begin: "solid", word: "facet", name: "an STL mesh", kind: "stl" },
  { begin: "v ", word: "\nv ", name: "an OBJ mesh", kind: "obj" },
  { begin: "mtllib", name: "an OBJ mesh", kind: "obj" },
  { begin: "{", word: '"asset"', name: "a glTF", kind: "gltf" },
  { begin: "{", word: '"outline"', name: "an outline in JSON", kind: "outline" },
  { begin: "{", word: '"veins"', name: "a list of veins", advice: "open its leaf" },
  { begin: "<", word: "<svg", name: "a drawing (SVG)", kind: "svg" },
  { begin: "<", word: "<html", name: "a web page", advice: SAVE_FILE },
  { begin: "<", word: "<HTML", name: "a web page", advice: SAVE_FILE },
  {
    begin: "version https://git-lfs",
    name: "a pointer of Git LFS",
    advice: "fetch the file itself with git lfs pull",
  },
  { begin: "GIF8", name: "a GIF picture", advice: EXPORT_PICTURE },
  { begin: "RIFF", word: "WEBP", name: "a WebP picture", advice: EXPORT_PICTURE },
  { begin: "II*", name: "a TIFF picture", advice: EXPORT_PICTURE },
  { begin: "MM\0*", name: "a TIFF picture", advice: EXPORT_PICTURE },
  { begin: "BM", name: "a BMP picture", advice: EXPORT_PICTURE },
  { begin: "%PDF", name: "a PDF", advice: "export the outline as SVG" },
  { begin: "%!PS", name: "a PostScript file", advice: "export the outline as SVG" },
  { begin: "PK\x03\x04", name: "a ZIP archive", advice: "unpack it first" },
  { begin: "\x1f\x8b", name: "a gzip archive", advice: "unpack it first" },
  { begin: "BLENDER", name: "a Blender scene", advice: EXPORT_MESH },
  { begin: "Kaydara FBX", name: "an FBX scene", advice: EXPORT_MESH },
];

/** Read where the content alone does not tell: an OBJ may begin with any of its lines. */
const BY_EXTENSION: Record<string, ContentKind> = {
  ".obj": "obj",
  ".stl": "stl",
  ".json": "outline",
  ".svg": "svg",
  ".gltf": "gltf",
};
const POINTS = [".xyz", ".txt", ".csv"];

export function extensionOf(name: string): string {
  const dot = name.lastIndexOf(".");
  return dot < 0 ? "" : name.slice(dot).toLowerCase();
}

// Without a byte order mark, blanks, and lines of comments.
function stripped(text: string): string {
  let rest = text.replace(/^\xef\xbb\xbf/, "");
  for (;;) {
    rest = rest.replace(/^[ \t\r\n]+/, "");
    if (!rest.startsWith("#")) return rest;
    const end = rest.indexOf("\n");
    rest = end < 0 ? "" : rest.slice(end);
  }
}

// A binary STL has no mark: a header of 80 bytes, a count, 50 bytes for each triangle.
function isBinaryStl(bytes: Uint8Array): boolean {
  if (bytes.length < 84) return false;
  const count = new DataView(bytes.buffer, bytes.byteOffset).getUint32(80, true);
  return bytes.length === 84 + 50 * count;
}

/** The kind of a leaf file. Throws when it is none, saying what it is and how to mend it. */
export function contentKind(bytes: Uint8Array, fileName: string): ContentKind {
  if (bytes.length === 0) throw new Error("it is empty; write it again");
  // Latin-1: one character for each byte.
  const head = stripped(String.fromCharCode(...bytes.subarray(0, 4096)));
  for (const known of KNOWN) {
    if (!head.startsWith(known.begin) || !head.includes(known.word ?? "")) continue;
    if (known.kind) return known.kind;
    throw new Error(`it holds ${known.name}, which is no leaf: ${known.advice}`);
  }
  if (isBinaryStl(bytes)) return "stl";
  const extension = extensionOf(fileName);
  const kind = BY_EXTENSION[extension];
  if (kind) return kind;
  if (POINTS.includes(extension))
    throw new Error(
      `a scan's points are not read here but by the program: wilt simulate ${fileName} -o out.glb; drop its .glb`,
    );
  throw new Error("it is no kind of leaf file; allowed are .obj .ply .stl .glb .gltf .svg .json .png .jpg");
}
