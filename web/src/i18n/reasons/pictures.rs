//! Pictures that are not read, in words.

use sightline::error::{Damage, PictureKind};

/// Kind of a picture that is not supported.
pub fn picture(kind: &PictureKind) -> String {
    use PictureKind as K;
    let plain = match kind {
        K::Named(_) | K::Raw(_) => return kind.to_string(),
        K::RawLayered(format) => return format!("적층형 센서의 RAW({format})"),
        K::RawSamples(format, samples) => return format!("화소마다 값이 {samples}개인 RAW({format})"),
        K::RawCamera(format, camera) => return format!("{camera} 카메라의 RAW({format})"),
        K::HeifOf(items) => return format!("{items} 형식을 담은 HEIF"),
        K::Rare(format) => return format!("드문 방식의 {format}"),
        K::HeifOverlay => "여러 영상을 겹쳐 놓은 HEIF",
        K::Video => "MP4 또는 QuickTime 동영상",
        K::FloatingPoint => "부동소수점 영상",
        K::DeepPalette => "팔레트가 1, 2, 4, 8비트가 아닌 TIFF",
        K::LosslessJpeg => "무손실 JPEG",
        K::HierarchicalJpeg => "계층형 JPEG",
        K::ArithmeticJpeg => "산술 부호화 JPEG",
        K::TwelveBitJpeg => "12비트 JPEG",
        K::OddJpeg => "8비트가 아닌 JPEG",
        K::JpegWithoutHeight => "헤더에 높이가 없는 JPEG",
    };
    plain.to_owned()
}

/// Error of a picture's file.
pub fn damage(damage: &Damage) -> String {
    match damage {
        Damage::EndsEarly => "파일이 중간에 끝납니다".to_owned(),
        Damage::NoPicture => "영상이 들어 있지 않습니다".to_owned(),
        Damage::Header => "머리 부분이 손상되었습니다".to_owned(),
        Damage::NoPalette => "색상표가 없습니다".to_owned(),
        Damage::ClaimsTooMuch { width, height } => {
            format!("머리 부분에 적힌 {width} × {height}화소를 파일의 바이트가 담을 수 없습니다")
        }
        Damage::NoWholeRow => "온전하다고 할 수 있는 행이 없습니다".to_owned(),
        Damage::Rows { first, last } => format!("{first}–{last}행이 손상되었습니다"),
        Damage::Decoder { message } => message.clone(),
    }
}
