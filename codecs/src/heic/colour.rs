//! Colours out of luma and chroma (ITU-T H.273, table 4).

use heifer_isobmff::boxes::{ColorInfo, Property};
use heifer_isobmff::{HeifFile, ItemId};

use super::{Planes, property};

/// How luma and chroma make red, green and blue.
#[derive(Clone, Copy, Debug)]
pub struct Matrix {
    red: f32,
    blue: f32,
    full_range: bool,
}

impl Matrix {
    /// Size of the picture: from the file, else from its first tile, else from the coded stream.
    pub fn of(file: &HeifFile, picture: ItemId, tile: ItemId, planes: &Planes) -> Self {
        let nclx_of = |id| {
            let nclx = |property: &Property| match property {
                Property::Color(ColorInfo::Nclx { matrix, full_range, .. }) => Some((*matrix, *full_range)),
                _ => None,
            };
            property(file, id, nclx).ok().flatten()
        };
        let (code, full_range) =
            nclx_of(picture).or_else(|| nclx_of(tile)).unwrap_or((planes.matrix.into(), planes.full_range));
        let (red, blue) = match code {
            1 => (0.2126, 0.0722),
            9 | 10 => (0.2627, 0.0593),
            _ => (0.299, 0.114),
        };
        Self { red, blue, full_range }
    }

    /// Red, green and blue from 0 to 255, not yet bounded.
    pub fn rgb(&self, luma: f32, [cb, cr]: [f32; 2]) -> [f32; 3] {
        let (y, stretch) = if self.full_range { (luma, 1.0) } else { ((luma - 16.0) * 255.0 / 219.0, 255.0 / 224.0) };
        let (cb, cr) = (cb * stretch, cr * stretch);
        let (red, blue) = (y + 2.0 * (1.0 - self.red) * cr, y + 2.0 * (1.0 - self.blue) * cb);
        [red, (y - self.red * red - self.blue * blue) / (1.0 - self.red - self.blue), blue]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grey_stays_grey_and_colours_come_back() {
        let matrix = Matrix { red: 0.299, blue: 0.114, full_range: true };
        assert_eq!(matrix.rgb(100.0, [0.0; 2]), [100.0; 3]);
        let [r, g, b] = [200.0f32, 90.0, 30.0];
        let y = 0.299 * r + 0.587 * g + 0.114 * b;
        let back = matrix.rgb(y, [(b - y) / 1.772, (r - y) / 1.402]);
        assert!([r, g, b].iter().zip(back).all(|(there, back)| (there - back).abs() < 1e-3), "{back:?}");
        let narrow = Matrix { full_range: false, ..matrix };
        assert_eq!(narrow.rgb(16.0, [0.0; 2]), [0.0; 3]);
        assert!((narrow.rgb(235.0, [0.0; 2])[1] - 255.0).abs() < 1e-3);
    }
}
