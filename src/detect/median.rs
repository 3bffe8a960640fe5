//! Medians of non-negative numbers, which have the order of their bits and are compared faster.

/// The median, the upper one of two; 0 of nothing. `scratch` is memory that is reused.
pub(crate) fn of_sizes(sizes: impl Iterator<Item = f32>, scratch: &mut Vec<u32>) -> f64 {
    scratch.clear();
    scratch.extend(sizes.map(f32::to_bits));
    if scratch.is_empty() {
        return 0.0;
    }
    let half = scratch.len() / 2;
    f64::from(f32::from_bits(*scratch.select_nth_unstable(half).1))
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn it_is_the_middle_one() {
        let mut scratch = Vec::new();
        assert_eq!(of_sizes([3.5, 0.0, 1e9, 2.0, 7.0].into_iter(), &mut scratch), 3.5);
        assert_eq!(of_sizes([2.0, f32::INFINITY].into_iter(), &mut scratch), f64::INFINITY);
        assert_eq!(of_sizes(std::iter::empty(), &mut scratch), 0.0);
    }
}
