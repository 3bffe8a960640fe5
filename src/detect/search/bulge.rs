//! Targets on a line of the same brightness that runs through them: detected where the blob is wider.
//!
//! A cable across a target of its own tone makes one long blob of both. Most of its border is the cable's, but the target is
//! wider: the rows that are wider than the cable are those of the target, and are tested as a blob of their own. How wide the cable
//! is the narrow ones of the rows tell; what share of the rows they are depends on its length.

use super::blob::{self, BlobLimits};
use super::component::Chord;
use super::partial;
use crate::detect::acceptance::bulge::{NARROW, WIDER};
use crate::detect::acceptance::partial::RUNS;
use crate::detect::ellipse::outline::Outline;

/// The ellipses of the pieces of a chain that are wider than the rest of it.
pub(crate) fn bulges(chain: &[Chord], limits: &BlobLimits) -> Vec<Outline> {
    let mut found = Vec::new();
    if chain.len() < 2 * RUNS {
        return found;
    }
    let width = |chord: &Chord| chord.x1 - chord.x0;
    let mut widths: Vec<f32> = chain.iter().map(width).collect();
    widths.sort_unstable_by(f32::total_cmp);
    for share in NARROW {
        let narrow = WIDER * widths[(share * chain.len() as f64) as usize];
        // the whole of it was tested
        let wide = chain.chunk_by(|a, b| (width(a) > narrow) == (width(b) > narrow));
        for piece in wide.filter(|piece| piece.len() >= RUNS && piece.len() < chain.len() && width(&piece[0]) > narrow)
        {
            found.extend(blob::test(piece, limits).ok().or_else(|| partial::most(piece, limits)));
        }
        if !found.is_empty() {
            break;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    const LIMITS: BlobLimits =
        BlobLimits { min_diameter: 5.0, max_diameter: 400.0, flattest: 0.22, width: 300, height: 400, step: 2 };

    /// What discs and an upright band cover together, in every second row; the band goes sideways by `lean` a row.
    fn joined(discs: &[Outline], x: f64, lean: f64, half: f64, rows: std::ops::Range<f64>) -> Vec<Chord> {
        let row = |k: i32| {
            let y = f64::from(2 * k) + 0.5;
            let band = rows.contains(&y).then_some((x + lean * y - half, x + lean * y + half));
            let all = discs.iter().filter_map(|disc| disc.chord(y)).chain(band);
            let run = all.reduce(|(a, b), (c, d)| (a.min(c), b.max(d)));
            run.map(|(x0, x1)| Chord::new(x0 as f32, x1 as f32, y as f32, false))
        };
        (0..200).filter_map(row).collect()
    }

    #[test]
    fn a_target_on_a_cable_is_where_both_are_wide() {
        let truth = Outline::from_axes(100.3, 180.2, 20.0, 15.0, 0.6);
        // ends at the rim, goes on a little, is long; upright and slanted, through the middle and beside it
        for rows in [150.0..200.0, 140.0..220.0, 0.0..390.0] {
            for (lean, aside) in [(0.0, 0.0), (0.4, 0.0), (-0.3, 4.0)] {
                let chain = joined(&[truth], truth.u + aside - lean * truth.v, lean, 3.0, rows.clone());
                assert!(blob::test(&chain, &LIMITS).is_err());
                let all = bulges(&chain, &LIMITS);
                let [outline] = all[..] else { panic!("{rows:?} {lean} {aside}: {all:?}") };
                let off = (outline.u - truth.u).hypot(outline.v - truth.v);
                assert!(off < 1.0, "{rows:?} {lean} {aside}: {outline:?}");
            }
        }
    }

    #[test]
    fn a_cable_may_run_across_several_targets() {
        let discs = [80.0, 160.0, 260.0].map(|v| Outline::from_axes(100.0, v + 0.3, 18.0, 18.0, 0.0));
        let all = bulges(&joined(&discs, 101.0, 0.0, 3.0, 0.0..390.0), &LIMITS);
        assert_eq!(all.len(), 3, "{all:?}");
        for (outline, disc) in all.iter().zip(&discs) {
            assert!((outline.u - disc.u).hypot(outline.v - disc.v) < 0.5, "{outline:?}");
        }
    }

    #[test]
    fn bars_steps_and_boxes_on_a_bar_have_none() {
        let rows = |half: fn(usize) -> f32| -> Vec<Chord> {
            (0..60).map(|k| Chord::new(100.0 - half(k), 100.0 + half(k), 2.0 * k as f32 + 0.5, false)).collect()
        };
        assert!(bulges(&rows(|_| 6.0), &LIMITS).is_empty());
        assert!(bulges(&rows(|k| if k < 30 { 4.0 } else { 16.0 }), &LIMITS).is_empty());
        assert!(bulges(&rows(|k| if (20..40).contains(&k) { 18.0 } else { 4.0 }), &LIMITS).is_empty());
        assert!(bulges(&rows(|k| 2.0 + 0.3 * k as f32), &LIMITS).is_empty());
    }
}
