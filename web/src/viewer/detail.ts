// How finely pictures are drawn, on fast machines and slow ones.

/** ms between pictures: more, and they get plainer. */
export const SLOW = 45;
/** ms without movement until a slow machine draws in full detail. */
export const REST = 500;
/** Pixels to a CSS pixel. */
export const FULL_DETAIL = Math.min(devicePixelRatio, 2);
/** `pixels`: share of FULL_DETAIL; `shadow`: texels a side. */
export const LEVELS = [
  { pixels: 1, shadow: 1024, blur: 12 },
  { pixels: 0.75, shadow: 512, blur: 6 },
  { pixels: 0.5, shadow: 512, blur: 4 },
];
