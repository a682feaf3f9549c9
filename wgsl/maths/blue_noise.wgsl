// Blue noise: offsets that differ most between neighbouring pixels, so that what they leave of an error is of high frequency and
// a small filter takes it away.
//
// A tile of 16 x 16 pixels, made by void and cluster (Ulichney, "The void-and-cluster method for dither array generation", SPIE
// 1993); a test makes it anew. From frame to frame offsets turn by the golden ratio.

// The ranks of a row of pixels in each vector, 0 to 255, four in a component, the first one in its lowest bits.
const BLUE_NOISE_TILE: array<vec4u, 16> = array<vec4u, 16>(
    vec4u(1638125133u, 2700001316u, 3308776017u, 2522693239u),
    vec4u(3695389567u, 445135738u, 3784354420u, 3257246744u),
    vec4u(160623376u, 3647338665u, 1265109187u, 3748722311u),
    vec4u(3412833881u, 714610256u, 3039297095u, 2923824599u),
    vec4u(838016133u, 1525004937u, 882556288u, 799000411u),
    vec4u(1603879638u, 2718318552u, 4050718671u, 4200997502u),
    vec4u(2885794165u, 1777957663u, 357755192u, 294577320u),
    vec4u(2212976076u, 2444514528u, 3381375264u, 911130176u),
    vec4u(1030498470u, 3574870212u, 786326085u, 3986359158u),
    vec4u(201102103u, 4067402125u, 2651749825u, 2086916605u),
    vec4u(3501346010u, 72869449u, 1256991125u, 3140624746u),
    vec4u(1680634631u, 981909275u, 3083689133u, 4116230026u),
    vec4u(4103980684u, 4213614457u, 1008564443u, 1100802058u),
    vec4u(3545439970u, 1590313997u, 3718596626u, 1729742957u),
    vec4u(897890361u, 2540888975u, 2499248572u, 2877435215u),
    vec4u(4027805439u, 855660208u, 207627218u, 47509427u),
);

// The offset of a pixel, in (0, 1), turned by `turn` from 0 to 1: the same in all frames if that is 0.
fn blue_noise_offset(pixel: vec2u, turn: f32) -> f32 {
    let place = pixel & vec2u(15u);
    var tile = BLUE_NOISE_TILE;
    let word = tile[place.y][place.x >> 2u];
    let rank = (word >> (8u * (place.x & 3u))) & 255u;
    // Less than 1 however the sum is rounded.
    return min(fract((f32(rank) + 0.5) / 256.0 + turn), 0.99999994);
}
