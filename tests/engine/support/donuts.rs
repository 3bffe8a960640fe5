//! Pictures of donuts drawn at random: discs with a hole, of both polarities, tilted, blurred, with the hole aside.

use super::painter::{Canvas, Spot, Uniform};

/// A disc and its hole.
#[derive(Clone, Copy, Debug)]
pub struct Donut {
    pub outer: Spot,
    pub inner: Spot,
}

/// Cells of a picture in a row and in a column, and their side in pixels.
const GRID: usize = 4;
const CELL: f64 = 190.0;

/// A picture of donuts from 30 to 110 px with holes of 0.2 to 0.7 of that; `aside` is the largest distance of the centres in pixels.
pub fn picture(random: &mut Uniform, aside: f64) -> (Canvas, Vec<Donut>) {
    let side = (GRID as f64 * CELL) as usize;
    let dark = random.next() < 0.5;
    let [ground, ink] = if dark {
        let paper = random.within(140.0, 220.0);
        [paper, paper - random.within(50.0, 110.0)]
    } else {
        let card = random.within(15.0, 60.0);
        [card, card + random.within(60.0, 160.0)]
    };
    let blur = random.within(0.6, 1.5);
    let mut canvas = Canvas::new(side, side, ground);
    let donuts: Vec<Donut> = (0..GRID * GRID)
        .map(|k| {
            let mut place = |i: usize| (i as f64 + 0.5) * CELL + random.within(-10.0, 10.0);
            let (u, v) = (place(k % GRID), place(k / GRID));
            let a = random.within(15.0, 55.0);
            let (b, angle) = (a * random.within(0.5, 1.0), random.within(0.0, 3.1));
            // what a hole of the smallest size and a disc of two pixels leave
            let share = random.within(0.2f64.max(2.8 / b), 0.7f64.min(1.0 - 3.0 / b));
            let (turn, off) = (random.within(0.0, std::f64::consts::TAU), random.within(0.0, aside));
            // the ground that shows in the hole
            let level = random.within(0.7, 1.1) * (ground - ink);
            let outer = Spot { u, v, a, b, angle, contrast: ink - ground };
            let inner = Spot {
                u: u + off * turn.cos(),
                v: v + off * turn.sin(),
                a: share * a,
                b: share * b,
                contrast: level,
                ..outer
            };
            Donut { outer, inner }
        })
        .collect();
    for Donut { outer, inner } in &donuts {
        canvas.add(outer, blur);
        canvas.add(inner, blur);
    }
    (canvas, donuts)
}
