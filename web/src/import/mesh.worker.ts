// The reader of mesh files in a thread of its own.

import * as Comlink from "comlink";
import { type MeshKind, parseMesh } from "./mesh_file";

Comlink.expose({
  async parseMesh(bytes: Uint8Array, kind: MeshKind) {
    const mesh = await parseMesh(bytes, kind);
    const arrays = [mesh.positions, mesh.faces, ...(mesh.uv ? [mesh.uv] : [])];
    return Comlink.transfer(
      mesh,
      arrays.map((array) => array.buffer),
    );
  },
});
