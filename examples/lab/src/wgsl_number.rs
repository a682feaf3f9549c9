//! Numbers as the library's modules state them: there they stand once.

use moment_shadows::modules;

/// The numbers that a constant of a module is made of; `None` where there is no such constant, or no number in it.
pub(crate) fn numbers(module: &str, name: &str) -> Option<Vec<f64>> {
    let mut all = modules().iter();
    let text = all.find(|it| it.name == module)?.source;
    let (_, declared) = text.split_once(&format!("\nconst {name}:"))?;
    let (_, value) = declared.split_once(';')?.0.split_once('=')?;
    // A constructor's name is no number, nor is the count in an array's.
    let parts = value.split(['(', ')', ',', '<', '>']).map(str::trim);
    let numbers: Vec<f64> = parts.filter_map(|part| part.parse().ok()).collect();
    let count = usize::from(value.trim_start().starts_with("array<"));
    numbers
        .get(count..)
        .filter(|it| !it.is_empty())
        .map(<[f64]>::to_vec)
}

#[cfg(test)]
mod tests {
    use super::numbers;

    #[test]
    fn a_number_a_vector_and_a_list_are_read() {
        let smallest = numbers("two_moments", "TWO_MOMENTS_SMALLEST_VARIANCE_UNORM16");
        assert_eq!(smallest, Some(vec![6e-5]));
        let smallest = numbers(
            "exponential_variance",
            "EXPONENTIAL_VARIANCE_SMALLEST_FLOAT16",
        );
        assert_eq!(smallest, Some(vec![2.2e-3, 9e-8]));
        let bounds = numbers("convolution", "CONVOLUTION_BOUNDS").unwrap_or_default();
        assert_eq!((bounds.len(), bounds.first()), (32, Some(&0.2622)));
        assert_eq!(numbers("convolution", "NOTHING"), None);
    }
}
