import super::super::techniques::layered_variance::{LayeredVarianceLayers, layered_variance_count, layered_variance_split};

// Lloyd relaxation: moves the splits of layers to where light would bleed.
//
// Behind an edge between two surfaces light bleeds onto receivers behind the second one, and a split at that second occluder
// prevents it. In a small footprint of the map with mean mu and standard deviation sigma the second occluder is at mu + sigma
// where each covers half, and the bleeding grows with sigma^2 (Lauritzen & McCool, "Layered Variance Shadow Maps", GI 2008,
// section 5; Lauritzen, thesis 2008, section 4.1.3). A third moment gives it for any coverage. But the second occluder is itself
// a receiver, and slopes on both sides of such a split: here splits are wanted a sixth of the gap in front of it, where pictures
// err less. So these places of all 2x2 footprints, weighted by their variance, are clustered: the cell of a split reaches halfway
// to the splits beside it, and a split moves to the mean of its cell. Two splits per frame suffice, so their sums fit one texel.
// A split whose cell is empty is of no use: its two layers merge, and the layer beside the split of greatest weight is split
// instead.

// The layers, and the weight that the cell of each split had when it was last summed. Zeroed weights are a valid start.
struct LloydState {
    layers: LayeredVarianceLayers,
    weights: array<vec4f, 2>,
}

// Where the four depths of a footprint want a split, and its weight, the variance. A distribution on two depths has them at
// mu + (h -+ gap) / 2 with gap = sqrt(h^2 + 4 sigma^2), where h is the third central moment over the variance: two depths have
// the first three moments of any distribution (the sparse representation of Peters et al., JCGT 6(1) 2017). The farther one is
// mu + sigma where h is 0; on a diagonal edge, of which footprints see one or three quarters, mu + sigma alone is 7 % of the gap
// too near. The split is 5 / 6 of the gap behind the nearer one.
fn lloyd_wanted_split(depths: vec4f) -> vec2f {
    let mean = dot(depths, vec4f(0.25));
    let deviations = depths - mean;
    let squares = deviations * deviations;
    let variance = dot(squares, vec4f(0.25));
    // At most the largest deviation, if not zero.
    let skew = 0.25 * dot(squares, deviations) / max(variance, 1e-30);
    let gap = sqrt(fma(skew, skew, 4.0 * variance));
    return vec2f(mean + 0.5 * skew + gap / 3.0, variance);
}

// The split that is moved together with split `first`; `first` itself if there is no other.
fn lloyd_second_split(layers: LayeredVarianceLayers, first: u32) -> u32 {
    return (first + 1u) % max(layered_variance_count(layers) - 1u, 1u);
}

// The cell of a split.
fn lloyd_cell(layers: LayeredVarianceLayers, split: u32) -> vec2f {
    let own = layered_variance_split(layers, split);
    var cell = vec2f(-1.0, 1.0);
    if split > 0u {
        cell.x = 0.5 * (layered_variance_split(layers, split - 1u) + own);
    }
    if split + 2u < layered_variance_count(layers) {
        cell.y = 0.5 * (own + layered_variance_split(layers, split + 1u));
    }
    return cell;
}

// What a wanted split (depth, weight) adds to the sums of a split: (weight * depth, weight) if it is in its cell.
fn lloyd_share(layers: LayeredVarianceLayers, split: u32, wanted: vec2f) -> vec2f {
    let cell = lloyd_cell(layers, split);
    // Cells are closed in front; the last one is closed behind as well.
    let inside = wanted.x >= cell.x && (wanted.x < cell.y || cell.y >= 1.0);
    return select(vec2f(0.0), vec2f(wanted.x * wanted.y, wanted.y), inside);
}

// What a footprint adds to the sums of the splits `first` (xy) and `lloyd_second_split` (zw). Depths are in [-1, 1].
fn lloyd_contribution(layers: LayeredVarianceLayers, first: u32, depths: vec4f) -> vec4f {
    let wanted = lloyd_wanted_split(depths);
    let second = lloyd_second_split(layers, first);
    return vec4f(lloyd_share(layers, first, wanted), lloyd_share(layers, second, wanted));
}

// Moves a split to the mean of its sums (weight * depth, weight), unless its cell is empty.
fn lloyd_moved(state: LloydState, split: u32, sums: vec2f) -> LloydState {
    var moved = state;
    moved.weights[split / 4u][split % 4u] = max(sums.y, 0.0);
    if sums.y > 0.0 {
        moved.layers.splits[split / 4u][split % 4u] = clamp(sums.x / max(sums.y, 1e-30), -1.0, 1.0);
    }
    return moved;
}

// Moves an empty split to the wider half of the cell of greatest weight, keeping the order; each gets half of the weight.
fn lloyd_teleported(state: LloydState, empty: u32) -> LloydState {
    let splits = layered_variance_count(state.layers) - 1u;
    var moved = state;
    var heaviest = empty;
    for (var split = 0u; split < splits; split++) {
        if moved.weights[split / 4u][split % 4u] > moved.weights[heaviest / 4u][heaviest % 4u] {
            heaviest = split;
        }
    }
    if heaviest == empty {
        return state;
    }
    let weight = 0.5 * moved.weights[heaviest / 4u][heaviest % 4u];
    moved.weights[heaviest / 4u][heaviest % 4u] = weight;
    let own = layered_variance_split(state.layers, heaviest);
    let cell = lloyd_cell(state.layers, heaviest);
    let position = 0.5 * (own + select(cell.x, cell.y, cell.y - own > own - cell.x));
    // The gap moves through the list until the new position fits into it.
    var gap = empty;
    while gap + 1u < splits && layered_variance_split(moved.layers, gap + 1u) < position {
        let next = gap + 1u;
        moved.layers.splits[gap / 4u][gap % 4u] = moved.layers.splits[next / 4u][next % 4u];
        moved.weights[gap / 4u][gap % 4u] = moved.weights[next / 4u][next % 4u];
        gap = next;
    }
    while gap > 0u && layered_variance_split(moved.layers, gap - 1u) > position {
        let before = gap - 1u;
        moved.layers.splits[gap / 4u][gap % 4u] = moved.layers.splits[before / 4u][before % 4u];
        moved.weights[gap / 4u][gap % 4u] = moved.weights[before / 4u][before % 4u];
        gap = before;
    }
    moved.layers.splits[gap / 4u][gap % 4u] = position;
    moved.weights[gap / 4u][gap % 4u] = weight;
    return moved;
}

// One step: moves split `first` and its second by the sums of `lloyd_contribution` over all footprints, and moves one of them
// elsewhere if its cell is empty. With one layer there is nothing to move.
fn lloyd_step(state: LloydState, first: u32, sums: vec4f) -> LloydState {
    let splits = layered_variance_count(state.layers) - 1u;
    if splits == 0u {
        return state;
    }
    let one = min(first, splits - 1u);
    let two = lloyd_second_split(state.layers, one);
    var moved = lloyd_moved(state, one, sums.xy);
    if two != one {
        moved = lloyd_moved(moved, two, sums.zw);
    }
    if sums.y <= 0.0 {
        return lloyd_teleported(moved, one);
    }
    if two != one && sums.w <= 0.0 {
        return lloyd_teleported(moved, two);
    }
    return moved;
}
