// The reduction of light leaking after the bound.

import { check } from './value_error.js';

const OF = 'leak reduction';

/**
 * The reduction: shadow intensity that counts as full shadow, in (0, 1]; visibility that counts as zero, in [0, 1); the exponent of
 * visibility, above 0. Without anything said it is a division by 0.98 alone.
 */
export function leakReduction({ fullShadow = 0.98, bleedReduction = 0, visibilityExponent = 1 } = {}) {
  const [full_shadow, bleed_reduction, visibility_exponent] = [fullShadow, bleedReduction, visibilityExponent].map(Math.fround);
  check(full_shadow > 0 && full_shadow <= 1, OF, 'full_shadow', fullShadow, 'above 0 and at most 1');
  check(bleed_reduction >= 0 && bleed_reduction < 1, OF, 'bleed_reduction', bleedReduction, 'at least 0 and below 1');
  const valid = visibility_exponent > 0 && Number.isFinite(visibility_exponent);
  check(valid, OF, 'visibility_exponent', visibilityExponent, 'above 0 and finite');
  return { full_shadow, bleed_reduction, visibility_exponent };
}
