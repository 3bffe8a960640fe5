//! What the engine's reasons name, in Korean: things, arguments, degenerate configurations.

use sightline::error::{Expected, Lack, Thing};
use sightline::initial::Degeneracy;
use sightline_exchange::reason::PhotoModelerPart;

/// Why an initial value cannot be computed.
pub fn degeneracy(degeneracy: &Degeneracy) -> String {
    match degeneracy {
        Degeneracy::TooFew { needed, given } => format!("점이나 광선이 {given}개인데 {needed}개가 필요합니다"),
        Degeneracy::Collinear => "점들이 한 직선 위에 있습니다".to_owned(),
        Degeneracy::Coplanar => "점들이 한 평면 위에 있습니다".to_owned(),
        Degeneracy::NearParallel { angle } => {
            format!("광선이 거의 평행합니다. 교차각이 {:.3}°입니다", angle.to_degrees())
        }
        Degeneracy::BehindCamera { ray } => format!("점이 {}번째 광선의 카메라 뒤에 있습니다", ray + 1),
        Degeneracy::NoSolution => "맞는 해가 없습니다".to_owned(),
    }
}

/// A thing that has a name.
pub fn thing(thing: Thing) -> &'static str {
    match thing {
        Thing::Camera => "카메라",
        Thing::Photo => "사진",
        Thing::Point => "점",
        Thing::DatumPoint => "기준계 점",
        Thing::Observation => "관측값",
        Thing::Distance => "거리",
        Thing::Parameter => "매개변수",
        Thing::FiducialMark => "사진지표",
        Thing::Reading => "측정값",
        Thing::File => "파일",
        Thing::Format => "형식",
        Thing::Experiment => "실험",
        Thing::Network => "망",
        Thing::Feature => "형상",
        Thing::System => "좌표계",
        Thing::ScaleBar => "축척 막대",
        Thing::Layer => "레이어",
        Thing::Epoch => "시기",
        Thing::Group => "묶음",
        Thing::CameraModel => "카메라 모형",
    }
}

/// What there is none of.
pub fn lack(lack: Lack) -> &'static str {
    match lack {
        Lack::Photos => "사진",
        Lack::Points => "점",
        Lack::Observations => "관측값",
        Lack::FiducialMarks => "사진지표",
        Lack::Cameras => "카메라",
        Lack::Readings => "측정값",
        Lack::Files => "파일",
        Lack::Adjustment => "광속조정 결과",
    }
}

/// A part of a PhotoModeler export.
pub fn photomodeler_part(part: PhotoModelerPart) -> &'static str {
    use PhotoModelerPart as P;
    match part {
        P::Heading => "머리글",
        P::Size => "사진 크기",
        P::Weights => "경중률",
        P::Camera => "카메라",
        P::CameraSigmas => "카메라의 표준오차",
        P::Photo => "사진",
        P::Exterior => "외부표정",
        P::ExteriorSigmas => "외부표정의 표준오차",
        P::PhotoCamera => "사진의 카메라",
        P::PhotoCameraSigmas => "사진 카메라의 표준오차",
    }
}

/// Expected kind of an argument.
pub fn expected(expected: Expected) -> &'static str {
    match expected {
        Expected::Object => "객체",
        Expected::Objects => "객체 목록",
        Expected::Function => "함수",
        Expected::Text => "텍스트",
        Expected::Bytes => "바이트(Uint8Array 또는 ArrayBuffer)",
        Expected::Samples => "행 순서의 표본(Uint8Array 또는 Uint16Array)",
        Expected::FiniteNumber => "유한한 수",
        Expected::Pixels => "정수 화소 수",
        Expected::Truth => "참 또는 거짓",
        Expected::TargetNumber => "1 이상의 표적 번호",
        Expected::PhotoId => "사진 식별자",
        Expected::PointId => "점 식별자",
        Expected::OneOrTwo => "수 하나 또는 둘",
        Expected::Role => "tie, control, check 가운데 하나",
        Expected::NumberOrNull => "수 또는 null",
        Expected::ThreeOrNull => "유한한 수 셋 또는 null",
        Expected::Plain => "객체, 목록, 텍스트, 수, true, false, null만으로 된 값",
        Expected::Tree => "자신을 포함하지 않는 값",
        Expected::Shallower => "32단계 이내로 겹친 값",
        Expected::Smaller => "더 작은 값",
        Expected::Attached => "다른 곳에 넘기지 않은 버퍼",
        Expected::SigmasOrNull => "수나 null 셋, 또는 null",
    }
}
