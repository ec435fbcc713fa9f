// How far apart two outlines are.

function distanceToSegment(px, py, ax, ay, bx, by) {
  const [ux, uy] = [bx - ax, by - ay];
  const t = Math.min(1, Math.max(0, ((px - ax) * ux + (py - ay) * uy) / (ux * ux + uy * uy || 1)));
  return Math.hypot(ax + t * ux - px, ay + t * uy - py);
}

/** From the points of one ring to the other line, the largest. */
function farthest(points, line) {
  let most = 0;
  for (let i = 0; i < points.length; i += 2) {
    let least = Infinity;
    for (let k = 0, j = line.length - 2; k < line.length; j = k, k += 2) {
      if (Math.abs(line[k] - points[i]) - 3 > least || Math.abs(line[k + 1] - points[i + 1]) - 3 > least) continue;
      least = Math.min(least, distanceToSegment(points[i], points[i + 1], line[j], line[j + 1], line[k], line[k + 1]));
    }
    most = Math.max(most, least);
  }
  return most;
}

/** Both ways; rings as [x, y, ...], in their unit. */
export function outlinesApart(a, b) {
  return Math.max(farthest(a, b), farthest(b, a));
}
