// The command line that gives the same run.
import type { Recipe } from "../session";

function quoted(word: string): string {
  return /^[\w./,:=-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

export function commandLine({ source, file, edits }: Recipe, config: string, output: string): string {
  const parts = ["wilt simulate", quoted(file?.name ?? source.name)];
  if (source.vertices > 0) parts.push(`--vertices ${source.vertices}`);
  parts.push(`--seed ${source.seed}`);
  if (file && file.nth > 1) parts.push(`--leaf ${file.nth}`);
  if (source.petiole) parts.push(`--petiole=${source.petiole.map((v) => Number(v.toFixed(3))).join(",")}`);
  if (edits.added.length + edits.removed.length > 0) parts.push("--veins veins.json");
  parts.push(`--config ${config}`, `-o ${output}`);
  return parts.join(" ");
}
