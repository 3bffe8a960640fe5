//! A rim without rendering: an expansion good to a few thousandths, which shows a fit the way.

use wide::f32x4;

use super::band::Band;
use crate::detect::ellipse::outline::Outline;
use crate::detect::normal::normal_distribution;

impl Band {
    /// Nearly the share and the derivatives, without rendering: across the rim an edge of variance s² + 1/12 (the pixel's own),
    /// with the light of a curved rim. With d the distance from the rim, z = d/σ, r that from the centre of curvature and
    /// ε = σ/r, a disc's derivative after its radius, φ(z)/σ sqrt(radius/r) (1 + ε²/8 ...), integrates to
    /// Φ(-z) - φ(z) (ε/2 + ε² z/8) in second order. Good to a few thousandths, enough to show the way. Without the derivatives (D) it
    /// costs half.
    #[inline(never)]
    pub fn sketch<const D: bool>(&mut self, outline: &Outline, blur: f64, origin: [f64; 2]) {
        let det = outline.p * outline.q - outline.r * outline.r;
        let [p, q, r] = [outline.p, outline.q, outline.r].map(|x| f32x4::splat((x / det) as f32));
        let [u, v] = [outline.u - origin[0], outline.v - origin[1]].map(|x| f32x4::splat(x as f32));
        let deviation = (blur * blur + 1.0 / 12.0).sqrt();
        let inverse = f32x4::splat(1.0 / deviation as f32);
        let widening = f32x4::splat((blur / deviation) as f32);
        // the rim's curvature is length³ / det² with `length` below, det A over the speed of the rim
        let curved = f32x4::splat((deviation / det / det) as f32);
        let [tiny, one, most] = [1e-12, 1.0, 4.0].map(f32x4::splat);
        let [half, eighth] = [0.5, 0.125].map(f32x4::splat);
        let [du, dv, ds, dp, dq, dr] = &mut self.derivatives;
        let [x, y, kept] = [&self.x, &self.y, &self.kept].map(|column| column.as_chunks::<4>().0);
        let pixels = x.iter().zip(y).zip(kept).zip(self.share.as_chunks_mut::<4>().0);
        let moves = du.as_chunks_mut::<4>().0.iter_mut().zip(dv.as_chunks_mut::<4>().0).zip(ds.as_chunks_mut::<4>().0);
        let shapes = dp.as_chunks_mut::<4>().0.iter_mut().zip(dq.as_chunks_mut::<4>().0).zip(dr.as_chunks_mut::<4>().0);
        for (((((x, y), kept), share), ((du, dv), ds)), ((dp, dq), dr)) in pixels.zip(moves).zip(shapes) {
            let (x, y, kept) = (f32x4::new(*x) - u, f32x4::new(*y) - v, f32x4::new(*kept));
            let (c, s) = (q * x - r * y, p * y - r * x);
            let root = (c * c + s * s + tiny).sqrt();
            let turn = one / root;
            let (c, s) = (c * turn, s * turn);
            // the normal, and the distance of the place from the rim along it
            let (nx, ny) = (q * c - r * s, p * s - r * c);
            let length = one / (nx * nx + ny * ny + tiny).sqrt();
            let (nx, ny) = (nx * length, ny * length);
            let z = (root - one) * length * inverse;
            let turn = turn.fast_min(most);
            let bounded = z.fast_max(f32x4::splat(-5.5)).fast_min(f32x4::splat(5.5));
            let (below, density) = normal_distribution(bounded);
            let bent = (curved * turn * length * length * length).fast_min(one);
            *share = (kept * (one - below - density * bent * (half + eighth * bent * bounded))).to_array();
            if !D {
                continue;
            }
            let edge = density * turn.sqrt() * inverse * kept;
            let (across, down) = (edge * nx, edge * ny);
            *du = across.to_array();
            *dv = down.to_array();
            *ds = (edge * z * widening).to_array();
            *dp = (c * across).to_array();
            *dq = (s * down).to_array();
            *dr = (s * across + c * down).to_array();
        }
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::detect::edges::surround::Surround;
    use crate::detect::rendered::Field;
    use crate::detect::rendered::band::PixelRegion;
    use crate::image::SampleView;

    #[test]
    fn a_sketch_is_nearly_what_is_rendered() {
        let samples = vec![0u8; 80 * 80];
        let plane = SampleView::new(80, 80, &samples);
        let surround = Surround {
            level: 0.0,
            slope: [0.0; 2],
            slope_covariance: [0.0; 3],
            noise: 1.0,
            contrast: 100.0,
            uneven: 0.0,
            outer: 8.0,
        };
        for (a, b, blur) in [(3.0, 3.0, 0.7), (6.0, 6.0, 0.7), (20.0, 20.0, 0.7), (20.0, 20.0, 2.0), (14.0, 9.0, 0.7)] {
            let outline = Outline::from_axes(40.3, 39.6, a, b, 0.4);
            let kept = [true; 20];
            let half_band = 3.6 * blur + 1.0;
            let (mut band, mut field) = (Band::default(), Field::default());
            let region = PixelRegion {
                outline,
                half_band,
                surround: &surround,
                light: [0.0; 2],
                multiplies: true,
                kept: &kept,
                whole: true,
                saturation: 255.0,
                stairs: false,
                quantum: 1.0,
                developed: false,
                shape: 0.0,
                prior: None,
            };
            field.place(&outline, blur, half_band);
            band.collect(&plane, &field, &region).unwrap();
            field.render(&outline, blur, true, &band.spans);
            band.gather(&field, [outline.u, outline.v], Some(&outline));
            let exact = [&band.share, &band.derivatives[0], &band.derivatives[1]].map(|column| column.to_vec());
            band.sketch::<true>(&outline, blur, [outline.u, outline.v]);
            let whole = band.share.clone();
            band.sketch::<false>(&outline, blur, [outline.u, outline.v]);
            assert_eq!(band.share, whole);
            let sketched = [&whole, &band.derivatives[0], &band.derivatives[1]];
            for ((exact, sketched), limit) in exact.iter().zip(sketched).zip([0.006, 0.02, 0.02]) {
                assert!(exact.iter().any(|x| *x > 0.1));
                let worst = exact.iter().zip(sketched).map(|(x, y)| (x - y).abs()).fold(0.0, f32::max);
                assert!(worst < limit, "{a} {b} {blur}: {worst}");
            }
        }
    }
}
