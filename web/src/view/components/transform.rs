//! From the stored pixel grid to the screen and back: EXIF orientation, zoom and shift.

use crate::browser::canvas::Affine;

/// How a photo lies on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Stored grid in pixels.
    pub size: [f64; 2],
    /// EXIF orientation, 1 to 8: coordinates stay on the stored grid, only the picture is turned.
    pub orientation: u8,
    /// Screen pixels per photo pixel.
    pub scale: f64,
    /// Where the upright picture's corner is on the screen.
    pub shift: [f64; 2],
}

impl Placement {
    /// The whole photo in the middle of a box.
    pub fn fitted(size: [f64; 2], orientation: u8, width: f64, height: f64) -> Self {
        let mut placement = Self { size, orientation, scale: 1.0, shift: [0.0; 2] };
        let [w, h] = placement.upright();
        placement.scale = (width / w).min(height / h).max(1e-3);
        placement.shift = [(width - w * placement.scale) / 2.0, (height - h * placement.scale) / 2.0];
        placement
    }

    /// Size of the upright picture in pixels.
    pub fn upright(&self) -> [f64; 2] {
        let [w, h] = self.size;
        if self.orientation >= 5 { [h, w] } else { [w, h] }
    }

    /// The map as a canvas takes it.
    pub fn affine(&self) -> Affine {
        let [w, h] = self.size;
        let turned: Affine = match self.orientation {
            2 => [-1.0, 0.0, 0.0, 1.0, w, 0.0],
            3 => [-1.0, 0.0, 0.0, -1.0, w, h],
            4 => [1.0, 0.0, 0.0, -1.0, 0.0, h],
            5 => [0.0, 1.0, 1.0, 0.0, 0.0, 0.0],
            6 => [0.0, 1.0, -1.0, 0.0, h, 0.0],
            7 => [0.0, -1.0, -1.0, 0.0, h, w],
            8 => [0.0, -1.0, 1.0, 0.0, 0.0, w],
            _ => [1.0, 0.0, 0.0, 1.0, 0.0, 0.0],
        };
        let [a, b, c, d, e, f] = turned.map(|x| x * self.scale);
        [a, b, c, d, e + self.shift[0], f + self.shift[1]]
    }

    pub fn to_screen(self, [u, v]: [f64; 2]) -> [f64; 2] {
        let [a, b, c, d, e, f] = self.affine();
        [a * u + c * v + e, b * u + d * v + f]
    }

    pub fn to_pixel(self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [a, b, c, d, e, f] = self.affine();
        let determinant = a * d - b * c;
        let (x, y) = (x - e, y - f);
        [(d * x - c * y) / determinant, (a * y - b * x) / determinant]
    }

    /// The angle on the screen of a direction in the photo.
    pub fn angle_on_screen(self, angle: f64) -> f64 {
        let [a, b, c, d, ..] = self.affine();
        let (sine, cosine) = angle.sin_cos();
        (b * cosine + d * sine).atan2(a * cosine + c * sine)
    }

    /// Zoomed by a factor, what lies under the pointer staying there.
    #[must_use]
    pub fn zoomed(self, factor: f64, [x, y]: [f64; 2]) -> Self {
        let scale = (self.scale * factor).clamp(0.01, 80.0);
        let ratio = scale / self.scale;
        Self { scale, shift: [x - (x - self.shift[0]) * ratio, y - (y - self.shift[1]) * ratio], ..self }
    }

    #[must_use]
    pub fn shifted(self, [x, y]: [f64; 2]) -> Self {
        Self { shift: [self.shift[0] + x, self.shift[1] + y], ..self }
    }

    /// With a photo pixel in the middle of a box.
    #[must_use]
    pub fn centred(self, pixel: [f64; 2], scale: f64, width: f64, height: f64) -> Self {
        let mut placement = Self { scale, shift: [0.0; 2], ..self };
        let [x, y] = placement.to_screen(pixel);
        placement.shift = [width / 2.0 - x, height / 2.0 - y];
        placement
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: [f64; 2], b: [f64; 2]) -> bool {
        (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9
    }

    #[test]
    fn every_orientation_keeps_the_picture_in_its_box_and_comes_back() {
        for orientation in 1..=8 {
            let p = Placement::fitted([400.0, 300.0], orientation, 800.0, 700.0);
            let [w, h] = p.upright();
            for corner in [[0.0, 0.0], [400.0, 0.0], [0.0, 300.0], [400.0, 300.0]] {
                let [x, y] = p.to_screen(corner);
                let inside = (-1e-9..=800.0 + 1e-9).contains(&x) && (-1e-9..=700.0 + 1e-9).contains(&y);
                assert!(inside, "{orientation}");
                assert!(close(p.to_pixel([x, y]), corner), "{orientation}");
            }
            assert_eq!(w > h, orientation < 5);
        }
    }

    #[test]
    fn a_quarter_turn_puts_the_first_pixel_at_the_top_right() {
        let p = Placement { size: [4.0, 3.0], orientation: 6, scale: 1.0, shift: [0.0; 2] };
        assert!(close(p.to_screen([0.0, 0.0]), [3.0, 0.0]));
        // A step on the screen is the map of a grid of no size.
        assert!(close(Placement { size: [0.0; 2], ..p }.to_pixel([0.0, 1.0]), [1.0, 0.0]));
    }

    #[test]
    fn zooming_keeps_the_place_under_the_pointer() {
        let p = Placement::fitted([400.0, 300.0], 1, 800.0, 700.0);
        let before = p.to_pixel([123.0, 456.0]);
        assert!(close(p.zoomed(1.7, [123.0, 456.0]).to_pixel([123.0, 456.0]), before));
    }
}
