//! Boxes around boxes around triangles, so that a search skips what lies beside it.

use glam::DVec3;

/// Items per leaf.
const LEAF: usize = 4;

/// A box by its centre and half its edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Box3 {
    pub(super) centre: DVec3,
    pub(super) half: DVec3,
}

/// A node. The first child of an inner node is the next node.
struct Node {
    bounds: Box3,
    /// The second child of an inner node; the first item of a leaf in `order`.
    next: u32,
    /// Items of a leaf; 0 for an inner node.
    items: u32,
}

/// A hierarchy over items that are known by their numbers.
pub(super) struct Bvh {
    nodes: Vec<Node>,
    order: Vec<u32>,
}

impl Bvh {
    /// Halves the items at the median of their centres along the axis on which those are spread farthest. The same items
    /// give the same hierarchy.
    pub(super) fn new(corners: &[[DVec3; 3]]) -> Self {
        let mut order: Vec<u32> = (0..corners.len() as u32).collect();
        let mut bvh = Self {
            nodes: Vec::with_capacity(corners.len()),
            order: Vec::new(),
        };
        if !order.is_empty() {
            bvh.split(corners, &mut order, 0);
        }
        bvh.order = order;
        bvh
    }

    fn split(&mut self, corners: &[[DVec3; 3]], items: &mut [u32], first: usize) {
        let centre = |item: u32| corners[item as usize].iter().sum::<DVec3>();
        let points = items.iter().flat_map(|&item| corners[item as usize]);
        let [low, high] = extremes(points);
        let node = self.nodes.len();
        self.nodes.push(Node {
            bounds: Box3 {
                centre: 0.5 * (low + high),
                half: 0.5 * (high - low),
            },
            next: first as u32,
            items: items.len() as u32,
        });
        if items.len() <= LEAF {
            return;
        }
        let [low, high] = extremes(items.iter().map(|&item| centre(item)));
        let spread = high - low;
        let axis = (0..3).fold(0, |widest, axis| {
            if spread[axis] > spread[widest] {
                axis
            } else {
                widest
            }
        });
        items.sort_unstable_by(|&a, &b| {
            let by_place = centre(a)[axis].total_cmp(&centre(b)[axis]);
            by_place.then(a.cmp(&b))
        });
        let (left, right) = items.split_at_mut(items.len() / 2);
        self.split(corners, left, first);
        self.nodes[node].next = self.nodes.len() as u32;
        self.nodes[node].items = 0;
        self.split(corners, right, first + left.len());
    }

    /// Calls `found` with the items of all leaves that `meets` some region, until it returns true.
    pub(super) fn search(
        &self,
        stack: &mut Vec<u32>,
        meets: impl Fn(&Box3) -> bool,
        mut found: impl FnMut(u32) -> bool,
    ) {
        stack.clear();
        if !self.nodes.is_empty() {
            stack.push(0);
        }
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if !meets(&node.bounds) {
                continue;
            }
            if node.items == 0 {
                stack.push(node.next);
                stack.push(index + 1);
                continue;
            }
            let first = node.next as usize;
            for &item in &self.order[first..first + node.items as usize] {
                if found(item) {
                    return;
                }
            }
        }
    }
}

fn extremes(points: impl Iterator<Item = DVec3>) -> [DVec3; 2] {
    points.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], at| {
        [low.min(at), high.max(at)]
    })
}
