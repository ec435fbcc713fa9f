// An SVG's elements, listed for the core, which chooses the leaf among its shapes as it does in a file. The browser's
// parser runs no script, opens nothing that the drawing refers to and reads no entity from elsewhere.

type ListedElement = [depth: number, name: string, attributes: Record<string, string>, text: string];

const LARGEST = 64 << 20; // bytes

/** JSON: [[depth, name, attributes, text of a style sheet], ...] in the document's order. */
export function listElements(text: string): string {
  if (text.length > LARGEST)
    throw new Error(`the drawing has ${text.length >> 20} MB; ${LARGEST >> 20} are allowed`);
  const parsed = new DOMParser().parseFromString(text, "image/svg+xml");
  const fault = parsed.querySelector("parsererror");
  if (fault) {
    const place = /line (\d+)[^\d]+(\d+)/.exec(fault.textContent ?? "");
    throw new Error(
      `it cannot be read as SVG${place ? `: it breaks off at line ${place[1]}, column ${place[2]}` : ""}`,
    );
  }
  const listed: ListedElement[] = [];
  const depths = new Map<Element, number>();
  const walker = parsed.createTreeWalker(parsed.documentElement, NodeFilter.SHOW_ELEMENT);
  for (let node: Node | null = walker.currentNode; node; node = walker.nextNode()) {
    const element = node as Element;
    const depth = element.parentElement ? depths.get(element.parentElement)! + 1 : 0;
    depths.set(element, depth);
    const attributes = Object.fromEntries(Array.from(element.attributes, ({ name, value }) => [name, value]));
    listed.push([
      depth,
      element.nodeName,
      attributes,
      element.localName === "style" ? (element.textContent ?? "") : "",
    ]);
  }
  return JSON.stringify(listed);
}
