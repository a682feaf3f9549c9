//! Loops in the code: a branch back to a label, and all that lies between.
//!
//! The driver weighs loop bodies by a fixed factor. Here they are weighed by how often they run, which the list of shaders
//! tells. Code outside loops counts once, both sides of a branch included: an upper bound.

use super::text::Code;

/// The instructions from the label on, up to the last branch back to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Loop {
    /// The first instruction.
    pub first: usize,
    /// The last instruction.
    pub last: usize,
}

/// The loops, in the order in which they begin; of two that begin together, the outer one first.
pub fn find(code: &Code) -> Result<Vec<Loop>, String> {
    let mut loops: Vec<Loop> = Vec::new();
    for (last, instruction) in code.instructions.iter().enumerate() {
        if !instruction.mnemonic.starts_with("s_branch")
            && !instruction.mnemonic.starts_with("s_cbranch")
        {
            continue;
        }
        let target = instruction.operands.split_whitespace().next();
        let target = target.unwrap_or_default();
        let first = code
            .labels
            .iter()
            .find(|(label, _)| label == target)
            .map(|&(_, first)| first)
            .ok_or_else(|| format!("a branch leads to '{target}', which is no label"))?;
        if first > last {
            continue;
        }
        // A loop may go on from several places.
        match loops.iter_mut().find(|known| known.first == first) {
            Some(known) => known.last = last,
            None => loops.push(Loop { first, last }),
        }
    }
    loops.sort_unstable();
    for (index, outer) in loops.iter().enumerate() {
        let crosses = |inner: &Loop| inner.first <= outer.last && inner.last > outer.last;
        if loops[index + 1..].iter().any(crosses) {
            return Err("two of its loops overlap without one holding the other".to_owned());
        }
    }
    Ok(loops)
}

/// How often each instruction runs: the product of the trip counts of the loops around it.
#[must_use]
pub fn weights(instructions: usize, loops: &[Loop], trips: &[u32]) -> Vec<f64> {
    let mut weights = vec![1.0; instructions];
    for (around, &trips) in loops.iter().zip(trips) {
        for weight in weights.iter_mut().take(around.last + 1).skip(around.first) {
            *weight *= f64::from(trips);
        }
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::isa::text::parse;

    fn code(text: &str) -> Code {
        parse(text).unwrap_or_default()
    }

    #[test]
    fn branches_back_are_loops_and_branches_on_are_not() {
        let code = code(
            "s_cbranch_scc1 BB3\nBB1:\nv_nop\nBB2:\nv_nop\ns_cbranch_scc0 BB2\ns_cbranch_vccz BB1\nBB3:\ns_endpgm",
        );
        let loops = find(&code).unwrap_or_default();
        let expected = [Loop { first: 1, last: 4 }, Loop { first: 2, last: 3 }];
        assert_eq!(loops, expected);
        assert_eq!(
            weights(code.instructions.len(), &loops, &[3, 5]),
            [1.0, 3.0, 15.0, 15.0, 3.0, 1.0]
        );
    }

    #[test]
    fn two_branches_back_to_one_label_are_one_loop() {
        let code = code("BB0:\nv_nop\ns_cbranch_scc1 BB0\nv_nop\ns_branch BB0\ns_endpgm");
        assert_eq!(find(&code), Ok(vec![Loop { first: 0, last: 3 }]));
    }

    #[test]
    fn straight_code_has_no_loop() {
        let code = code("v_nop\ns_branch BB9\nBB9:\ns_endpgm");
        assert_eq!(find(&code), Ok(vec![]));
        assert_eq!(weights(3, &[], &[]), [1.0; 3]);
    }

    #[test]
    fn what_cannot_be_weighed_is_an_error() {
        assert!(find(&code("s_branch BB7\ns_endpgm")).is_err());
        let crossed = "BB0:\nv_nop\nBB1:\nv_nop\ns_cbranch_scc1 BB0\ns_cbranch_scc1 BB1\ns_endpgm";
        assert!(find(&code(crossed)).is_err());
    }
}
