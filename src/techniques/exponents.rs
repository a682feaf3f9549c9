//! Exponents that are left out.

use super::{Finite, Technique};
use crate::Storage;

impl Technique {
    /// Its exponents with the usual ones.
    fn exponents(&mut self) -> Vec<(&mut Option<Finite>, Finite)> {
        match self {
            Technique::Esm { exponent, .. } => vec![(exponent, Finite(80.0))],
            Technique::Evsm2 { exponent } => vec![(exponent, Finite(40.0))],
            Technique::Evsm4 { positive, negative } => {
                vec![(positive, Finite(40.0)), (negative, Finite(5.0))]
            }
            Technique::Binary | Technique::Pcf(_) | Technique::Pcss { .. } => Vec::new(),
            Technique::Vsm | Technique::Lvsm { .. } | Technique::Convolution { .. } => Vec::new(),
            Technique::Hamburger4 | Technique::Hausdorff4 | Technique::Hamburger6 => Vec::new(),
        }
    }

    /// This technique in a storage: exponents that are left out are the usual ones, or the largest that the storage takes.
    #[must_use]
    pub(super) fn in_storage(mut self, storage: Storage) -> Self {
        let largest = self.row().largest_exponent(storage);
        for (exponent, usual) in self.exponents() {
            let fits = largest.is_none_or(|largest| usual.get() <= largest);
            let usual = if fits {
                Some(usual)
            } else {
                largest.map(Finite)
            };
            *exponent = exponent.or(usual);
        }
        self
    }

    /// This technique with the exponents of a map that was made for `other` where they are left out.
    #[must_use]
    pub fn on_map_of(mut self, other: &Technique) -> Self {
        if self.name() == other.name() {
            let mut other = other.clone();
            let of_map = other.exponents().into_iter();
            for ((exponent, _), (of_map, _)) in self.exponents().into_iter().zip(of_map) {
                *exponent = exponent.or(*of_map);
            }
        }
        self
    }
}
