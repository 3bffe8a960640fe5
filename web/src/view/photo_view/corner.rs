//! The corner of the photo that its overlay lies in: it makes way for the pointer and for what is chosen.

use leptos::prelude::*;

/// Width and height of the overlay, with its margins.
const OVER: [f64; 2] = [230.0, 260.0];
/// Corners for the overlay, in order of preference: whether on the right, whether at the bottom.
pub const CORNERS: [[bool; 2]; 4] = [[true, true], [false, true], [true, false], [false, false]];

/// The corner for the overlay: the present one while it covers none of the places that must stay visible, else the first that covers
/// the fewest.
fn free_corner(now: usize, [w, h]: [f64; 2], seen: &[[f64; 2]]) -> usize {
    let covers = |corner: usize| {
        let [right, bottom] = CORNERS[corner];
        let across = |x: f64| if right { x > w - OVER[0] } else { x < OVER[0] };
        let along = |y: f64| if bottom { y > h - OVER[1] } else { y < OVER[1] };
        seen.iter().filter(|[x, y]| across(*x) && along(*y)).count()
    };
    let others = (0..CORNERS.len()).filter(|corner| *corner != now);
    std::iter::once(now).chain(others).min_by_key(|corner| covers(*corner)).unwrap_or(now)
}

/// Keeps the overlay in a corner where it covers none of the places in `seen`, on the screen; its place in [`CORNERS`].
pub fn overlay_corner(bounds: RwSignal<[f64; 2]>, seen: impl Fn() -> Vec<[f64; 2]> + 'static) -> RwSignal<usize> {
    let corner = RwSignal::new(0_usize);
    Effect::new(move |_| {
        let now = corner.get_untracked();
        let free = free_corner(now, bounds.get(), &seen());
        if free != now {
            corner.set(free);
        }
    });
    corner
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_over_a_corner_covers_neither_the_pointer_nor_what_is_chosen() {
        let bounds = [700.0, 560.0];
        for k in 0..4000_u32 {
            let at = |salt: u32| f64::from((k * 7919 + salt * 104_729) % 1000) / 1000.0;
            let seen = [[700.0 * at(1), 560.0 * at(2)], [700.0 * at(3), 560.0 * at(4)]];
            let now = (k % 4) as usize;
            let free = free_corner(now, bounds, &seen);
            let [right, bottom] = CORNERS[free];
            for [x, y] in seen {
                let across = if right { x > 700.0 - OVER[0] } else { x < OVER[0] };
                let along = if bottom { y > 560.0 - OVER[1] } else { y < OVER[1] };
                assert!(!(across && along), "{seen:?} {free}");
            }
            // It keeps its position as long as it covers nothing.
            assert_eq!(free_corner(free, bounds, &seen), free);
        }
    }
}
