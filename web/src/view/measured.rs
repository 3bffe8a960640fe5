//! Samples and processing of a photo, in a sentence or two: a RAW's pixels, or the camera's processing of the picture.

use sightline::detection::{Colour, MeasuredOn, PictureReport, SampleSource};

use crate::format;
use crate::i18n::text;

/// Shares below this are not reported.
const WORTH: f64 = 0.005;
/// Increase of standard errors from which it is reported.
const GROWN: f64 = 1.05;

/// A share in percent; `None` if it is too small to report.
fn percent(share: f64) -> Option<String> {
    (share > WORTH).then(|| format::fixed(100.0 * share, 0))
}

/// Processing of the picture by the camera, with its effect on the measurement; empty if unknown.
pub fn picture_sentence(picture: &PictureReport) -> String {
    let noise = format::fixed(picture.noise, 1);
    let parts = [
        percent(picture.sharpening)
            .map(|percent| text::picture_sharpened(percent, format::fixed(picture.sharpening_radius, 1))),
        percent(picture.clipped_bright).map(text::picture_overexposed),
        percent(picture.clipped_dark).map(text::picture_black),
        percent(picture.compression).map(match picture.white_noise_assumed {
            true => text::picture_compressed_uncounted,
            false => text::picture_compressed,
        }),
        (picture.noise > 0.0).then(|| match picture.noise_correlation {
            factor if factor > GROWN => text::picture_shared_noise(&noise, format::fixed(factor, 1)),
            _ => text::picture_noise(&noise),
        }),
    ];
    let what = parts.into_iter().flatten().collect::<Vec<_>>().join("; ");
    if what.is_empty() { what } else { text::picture_sentence(what) }
}

/// Which sites, their noise, how many are over-exposed, and the lens data of the file.
pub fn sentence(measured: &SampleSource, picture: &PictureReport) -> String {
    let colour = measured.colour.map_or("", colour);
    let pattern = measured.pattern.clone().unwrap_or_default();
    let on = match measured.on {
        MeasuredOn::Sites => text::measured_on_sites(&measured.format, colour, pattern, measured.bits),
        MeasuredOn::InterpolatedSites => text::measured_between_sites(&measured.format, colour, pattern, measured.bits),
    };
    let gain = measured.gain.filter(|gain| *gain > 0.0);
    let noise = match (gain, measured.read_noise) {
        (Some(gain), Some(read)) => Some(text::measured_noise(format::fixed(read, 1), format::fixed(gain, 2))),
        (Some(gain), None) => Some(text::measured_light_noise(format::fixed(gain, 2))),
        (None, Some(read)) => Some(text::measured_read_noise(format::fixed(read, 1))),
        _ => None,
    };
    // Black is inside a sensor's scale: only at its bright end samples are clipped.
    let overexposed = percent(picture.clipped_bright).map(text::measured_overexposed);
    let hot = measured.hot_sites.filter(|count| *count > 0).map(|count| text::measured_hot(format::count(count)));
    let corrections =
        (!measured.corrections.is_empty()).then(|| text::measured_corrections(measured.corrections.join(", ")));
    let unread = (measured.unread_corrections > 0).then(|| text::unread_corrections().to_owned());
    [Some(on), noise, overexposed, hot, corrections, unread].into_iter().flatten().collect::<Vec<_>>().join(" ")
}

fn colour(colour: Colour) -> &'static str {
    match colour {
        Colour::Red => text::site_red(),
        Colour::Green => text::site_green(),
        Colour::Blue => text::site_blue(),
        Colour::Cyan => text::site_cyan(),
        Colour::Magenta => text::site_magenta(),
        Colour::Yellow => text::site_yellow(),
        Colour::White => text::site_white(),
        Colour::Emerald => text::site_emerald(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::i18n::{Language, in_language};

    fn told(picture: &PictureReport) -> [String; 2] {
        [Language::English, Language::Korean].map(|language| in_language(language, || picture_sentence(picture)))
    }

    #[test]
    fn all_that_a_camera_did_is_told_with_its_consequence_in_one_sentence() {
        let picture = PictureReport {
            sharpening: 0.8,
            sharpening_radius: 1.04,
            clipped_dark: 0.04,
            clipped_bright: 0.031,
            compression: 0.342,
            noise: 2.06,
            noise_correlation: 1.32,
            white_noise_assumed: false,
            softened: true,
        };
        let [english, korean] = told(&picture);
        assert_eq!(
            english,
            "This photo: sharpened by 80 % (radius 1.0 px), reversed where it hides targets; 3 % saturated, excluded from the fits; \
             4 % black, without detections; JPEG compression is visible (block borders 34 % stronger) and counts as noise; \
             noise 2.1 grey levels, correlated between neighbouring pixels, which makes the standard errors 1.3 times as large."
        );
        assert_eq!(
            korean,
            "이 사진: 선명화 80 %(반경 1.0 px), 이 때문에 표적이 가려지는 곳에서는 되돌림; 포화 3 %, 적합에서 제외함; \
             검정 4 %, 검출 없음; JPEG 압축 흔적이 보임(블록 경계 차이 34 % 큼), 잡음으로 계산함; \
             잡음 2.1 계조, 이웃 화소끼리 상관되어 표준오차가 1.3배로 커짐."
        );
    }

    #[test]
    fn what_a_camera_did_not_do_is_not_told() {
        let laboratory =
            PictureReport { noise: 1.5, noise_correlation: 1.0, clipped_bright: 0.004, ..Default::default() };
        assert_eq!(
            told(&laboratory),
            [
                "This photo: noise 1.5 grey levels, used for the standard errors.",
                "이 사진: 잡음 1.5 계조, 표준오차 계산에 사용함."
            ]
        );
        // A picture that is not softened may have been compressed all the same; a drawing has no noise.
        let compressed = PictureReport { compression: 0.08, ..PictureReport::default() };
        assert_eq!(
            told(&compressed),
            [
                "This photo: JPEG compression is visible (block borders 8 % stronger) and counts as noise.",
                "이 사진: JPEG 압축 흔적이 보임(블록 경계 차이 8 % 큼), 잡음으로 계산함.",
            ]
        );
        // Only least squares counts what neighbours share.
        assert_eq!(
            told(&PictureReport { white_noise_assumed: true, ..compressed }),
            [
                "This photo: JPEG compression is visible (block borders 8 % stronger); with this method the standard errors \
                 ignore it and are too small (use least squares).",
                "이 사진: JPEG 압축 흔적이 보이나(블록 경계 차이 8 % 큼) 이 방법의 표준오차에는 반영되지 않아 실제보다 작음(최소제곱 정합을 \
                 쓰십시오).",
            ]
        );
        assert_eq!(told(&PictureReport::default()), ["", ""]);
    }

    #[test]
    fn a_raw_is_told_how_much_of_it_is_over_exposed() {
        let measured =
            SampleSource { format: "DNG".into(), bits: 12, colour: Some(Colour::Green), ..SampleSource::default() };
        let told = |clipped_bright| sentence(&measured, &PictureReport { clipped_bright, ..PictureReport::default() });
        assert!(told(0.12).ends_with(". 12 % saturated, excluded from the fits."), "{}", told(0.12));
        assert!(!told(0.001).contains("saturated"));
    }
}
