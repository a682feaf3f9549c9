//! Depth distributions that are known exactly: finitely many surfaces with their shares of the filter kernel.

use dashu::rational::RBig;

use super::exact::{OracleError, rational};

/// A surface under the filter kernel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Atom {
    /// Its moment depth.
    pub depth: RBig,
    /// Its share, in (0, 1].
    pub weight: RBig,
}

/// A depth distribution of finitely many surfaces, whose shares sum to one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mixture {
    atoms: Vec<Atom>,
}

impl Mixture {
    /// A mixture of (moment depth, weight), the weights being scaled so that they sum to one exactly.
    ///
    /// Atoms whose weight is not positive are left out; a mixture without any other is an error.
    pub fn new(atoms: &[(f64, f64)]) -> Result<Self, OracleError> {
        let mut exact = Vec::with_capacity(atoms.len());
        for &(depth, weight) in atoms {
            let (depth, weight) = (rational(depth)?, rational(weight)?);
            if weight > RBig::ZERO {
                exact.push(Atom { depth, weight });
            }
        }
        let sum = exact
            .iter()
            .fold(RBig::ZERO, |sum, atom| sum + &atom.weight);
        if sum.is_zero() {
            return Err(OracleError::NoSurface);
        }
        for atom in &mut exact {
            atom.weight = &atom.weight / &sum;
        }
        Ok(Self { atoms: exact })
    }

    /// The surfaces.
    #[must_use]
    pub fn atoms(&self) -> &[Atom] {
        &self.atoms
    }

    /// The mixture whose moments a moment bias of `alpha` towards (0, `beta`, 0, `beta`) makes of this one's: a share
    /// `alpha` of occluders at the near end, the middle and the far end.
    pub fn biased(&self, alpha: f64, beta: f64) -> Result<Self, OracleError> {
        let (alpha, beta) = (rational(alpha)?, rational(beta)?);
        let rest = RBig::ONE - &alpha;
        let end = &beta * &alpha / RBig::from(2);
        let middle = (RBig::ONE - &beta) * &alpha;
        let bias = [
            (RBig::from(-1), end.clone()),
            (RBig::ZERO, middle),
            (RBig::ONE, end),
        ];
        let atoms = self
            .atoms
            .iter()
            .map(|atom| Atom {
                depth: atom.depth.clone(),
                weight: &atom.weight * &rest,
            })
            .chain(
                bias.into_iter()
                    .map(|(depth, weight)| Atom { depth, weight }),
            )
            .collect();
        Ok(Self { atoms })
    }

    /// The moments b_1..b_count, exactly.
    #[must_use]
    pub fn moments(&self, count: usize) -> Vec<RBig> {
        let mut terms: Vec<RBig> = self.atoms.iter().map(|atom| atom.weight.clone()).collect();
        (0..count)
            .map(|_| {
                let mut sum = RBig::ZERO;
                for (term, atom) in terms.iter_mut().zip(&self.atoms) {
                    *term = &*term * &atom.depth;
                    sum += &*term;
                }
                sum
            })
            .collect()
    }

    /// The four moments b_1..b_4, rounded to f64 once.
    #[must_use]
    pub fn four_moments(&self) -> [f64; 4] {
        let mut rounded = [0.0; 4];
        for (rounded, exact) in rounded.iter_mut().zip(self.moments(4)) {
            *rounded = exact.to_f64().value();
        }
        rounded
    }

    /// The shadow intensity Z(z < depth): the share of surfaces in front of `depth`.
    #[must_use]
    pub fn below(&self, depth: &RBig) -> f64 {
        self.share(|atom| atom.depth < *depth)
    }

    /// Z(z <= depth).
    #[must_use]
    pub fn at_or_below(&self, depth: &RBig) -> f64 {
        self.share(|atom| atom.depth <= *depth)
    }

    fn share(&self, counts: impl Fn(&Atom) -> bool) -> f64 {
        self.atoms
            .iter()
            .filter(|atom| counts(atom))
            .fold(RBig::ZERO, |sum, atom| sum + &atom.weight)
            .to_f64()
            .value()
    }
}
