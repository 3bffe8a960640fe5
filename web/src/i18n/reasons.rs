//! Why the engine refuses something, in Korean. The English is the engine's own.

mod above;
mod names;
mod pictures;

use std::fmt::Display;

use sightline::error::Reason;
use sightline_report::texts::particles::after;
use sightline_report::texts::template;

use names::expected;
pub use names::{degeneracy, lack, thing};
pub use pictures::{damage, picture};

/// A sentence whose particles follow its values.
fn filled(template: &str, values: &[(&str, &dyn Display)]) -> String {
    template::fill(template, values, after)
}

/// Forbidden words by folder.
pub fn reason(reason: &Reason) -> String {
    use Reason as R;
    let plain = match reason {
        R::NotJson { message } => return format!("Sightline 문서가 아닙니다: {message}"),
        R::NoEquipment { message } => return format!("Sightline 장비 파일이 아닙니다: {message}"),
        R::EquipmentVersion { version } => {
            return format!(
                "장비 파일의 버전이 {version}입니다. 여기서는 버전 1을 읽으므로 더 새 프로그램으로 여십시오"
            );
        }
        R::EquipmentTooLong { megabytes } => {
            return format!("장비 파일은 {megabytes} MB까지 읽는데, 이 파일은 더 큽니다");
        }
        R::BoardSize { given, needed } => {
            return format!(
                "주어진 값은 {given}입니다. 여기에는 {needed} 이상이 필요하고, 판의 원은 모두 10000개까지입니다"
            );
        }
        R::BoardPitch => "판의 원 간격은 0보다 커야 합니다",
        R::BoardDiameter => "판의 원 지름은 0보다 크고 원 사이 거리보다 작아야 합니다",
        R::BarIncomplete => "축척 막대에는 이름과 두 끝점, 단위가 있어야 합니다",
        R::Format { format, version } => {
            return format!("형식 \"{format}\" 버전 {version}입니다. 여기서는 \"sightline\" 버전 1을 읽습니다");
        }
        R::DamagedDocument { message } => return format!("문서가 손상되었습니다: {message}"),
        R::InteriorModel => "사진별 내부표정은 카메라와 같은 모형이어야 합니다",
        R::TargetDiameter => "표적 지름은 0보다 커야 합니다",
        R::TargetNormal => "표적의 법선은 방향이므로 세 성분이 모두 0일 수 없습니다",
        R::ImageSigma => "영상 관측값의 표준오차는 0화소보다 커야 합니다",
        R::DistanceEnds => "거리는 서로 다른 두 점을 잇습니다",
        R::DistanceLength => "거리는 0보다 커야 합니다",
        R::DistanceSigma => "거리의 표준오차는 0보다 커야 합니다",
        R::NotFinite => "유한하지 않거나 너무 큰 수가 있습니다",
        R::RigPosition => "리그 위치의 표준오차는 0보다 커야 합니다",
        R::RigRotation => "리그 회전의 표준오차는 1e-8 라디안 이상이어야 합니다. 그보다 단단한 고정 장치는 없습니다",
        R::RigColumns => {
            "리그의 각 촬영에는 카메라마다 한 자리씩 두 자리 이상이 있어야 합니다. 사진이 없는 카메라 자리는 null입니다"
        }
        R::RigCamera => {
            "리그의 한 열에 있는 사진은 모두 같은 카메라의 것이어야 합니다. 같은 열에 다른 카메라의 사진이 있습니다"
        }
        R::NegativeSigma => "표준오차는 0(고정) 이상이어야 합니다",
        R::PrincipalDistance => "주점거리는 0보다 커야 합니다",
        R::ParameterNotFinite => "매개변수는 유한한 수여야 합니다",
        R::SensorGrid => "센서 격자의 폭과 높이는 1화소 이상이어야 합니다",
        R::PixelPitch => "화소 크기는 0 mm보다 커야 합니다",
        R::ParameterSigma => "매개변수의 사전 표준오차는 0보다 커야 합니다. 고정하려면 비워 두십시오",
        R::FocalLengthTwice => "f는 fx와 fy를 하나로 나타냅니다. f만, 또는 fx와 fy를 추정하십시오",

        R::EpochShareMethod => {
            "카메라는 모든 시기를 한 번에 조정할 때만 공유합니다. 공동 조정, 시기별이 아닌 분산 인자, 참조점 기준계를 선택하고, 리그가 없고 시기마다 새로 측정한 기준점이 없는 프로젝트만 비교하거나, 카메라를 공유하지 마십시오"
        }
        R::EpochShareOptions { name, first } => {
            return format!(
                "시기 \"{first}\", \"{name}\"의 경중률 설정이 다르거나 분산 성분을 추정했습니다. 같은 설정으로 조정하거나 카메라를 공유하지 마십시오"
            );
        }
        R::EpochCameraMissing { camera, name } => {
            return format!(
                "시기 \"{name}\"에 카메라 \"{camera}\"의 정보가 없습니다. 모든 시기에서 같은 이름을 쓰거나 공유하지 마십시오"
            );
        }
        R::EpochCameraUnlike { camera, name, first } => {
            return format!(
                "카메라 \"{camera}\"의 모형, 센서, 추정할 매개변수 또는 고정값이 시기 \"{first}\", \"{name}\" 사이에서 다릅니다. 같게 설정하거나 공유하지 마십시오"
            );
        }
        R::EpochShareMany { points, limit } => {
            return format!(
                "모든 시기의 점이 {points}개입니다. 카메라를 공유하려면 한 번에 조정해야 하는데 {limit}개까지 할 수 있습니다. 시기나 점을 줄이거나 카메라를 공유하지 마십시오"
            );
        }
        R::EpochJointNotConverged => {
            "모든 시기의 공동 조정이 수렴하지 않았습니다. 카메라를 공유하지 않거나 좌표로 비교하십시오"
        }
        R::EpochsCount { given, limit } => {
            return format!("시기 {given}개를 주었습니다. 2개부터 {limit}개까지 비교합니다");
        }
        R::EpochSource { name } => {
            return format!("시기 \"{name}\"에는 프로젝트나 점 목록 가운데 하나만 있어야 합니다");
        }
        R::EpochNotConverged { name } => {
            return format!("시기 \"{name}\"의 조정이 수렴하지 않았습니다. 수렴하도록 프로젝트를 고친 뒤 비교하십시오");
        }
        R::EpochNoSigmas { name } => {
            return format!(
                "시기 \"{name}\"에 표준오차가 없어 변위를 검정할 수 없습니다. 점의 표준오차나 공분산 행렬을 주십시오"
            );
        }
        R::EpochUnit { name, unit, expected } => {
            return format!(
                "시기 \"{name}\"의 단위는 {unit}이고 앞선 시기의 단위는 {expected}입니다. 단위를 맞추십시오"
            );
        }
        R::EpochUnitRatio { name, ratio } => {
            return format!(
                "시기 \"{name}\"의 길이가 첫 시기의 {ratio}배입니다. 같은 단위로 주거나, 축척이 없는 시기로 표시하십시오"
            );
        }
        R::EpochMirrored { name } => {
            return format!(
                "시기 \"{name}\"의 좌표는 첫 시기의 거울상입니다. 두 축을 맞바꾸거나 한 축의 부호를 바꾸십시오"
            );
        }
        R::EpochUnlike { name, share } => {
            return format!(
                "시기 \"{name}\"의 점 배치가 첫 시기와 다릅니다(편차의 중앙값/크기: {share}). 같은 이름이 같은 점인지 확인하십시오"
            );
        }
        R::EpochNoCommon { name, first } => {
            return filled(
                "시기 \"{first}\"{first:과|와} 시기 \"{name}\"에 자동 번호가 아닌 공통점이 없습니다. 네 점 이상에 같은 이름을 주십시오",
                &[("first", first), ("name", name)],
            );
        }
        R::EpochReference { name, given, needed } => {
            return filled(
                "시기 \"{name}\"{name:과|와} 비교 시기의 공통 참조점이 {given}개이며 {needed}개 이상 필요합니다. 참조점을 더 지정하거나 두 시기에서 모두 측정하십시오",
                &[("name", name), ("given", given), ("needed", needed)],
            );
        }
        R::EpochReferenceLine => {
            "참조점이 한 직선 위에 있어 회전을 결정할 수 없습니다. 직선에서 벗어난 점을 참조점으로 지정하십시오"
        }
        R::EpochReferenceMany { given, limit } => {
            return format!(
                "참조점이 {given}개입니다. 한 번에 {limit}개까지 검정하므로 안정하다고 보는 점만 지정하십시오"
            );
        }
        R::EpochMatrix { rows, expected } => {
            return format!(
                "공분산 행렬의 행이 {rows}개이거나 행의 길이가 {expected}와 다릅니다. 점마다 행과 열이 셋씩인 행렬이나 그 하삼각이 필요합니다"
            );
        }
        R::EpochNotCovariance => {
            "공분산 행렬이 아닙니다. 대칭이어야 하고, 좌표의 어떤 조합도 분산이 음수일 수 없습니다"
        }
        R::DisplacedApart { given } => {
            return format!(
                "이 프로젝트와 비교 결과에 공통인 점이 {given}개입니다. 사진에 변위를 표시하려면 한 직선 위에 있지 않은 점이 세 개 이상 필요합니다. 비교한 시기의 프로젝트를 여십시오"
            );
        }
        R::EpochDate { text } => {
            return filled(
                "\"{text}\"{text:은|는} 날짜가 아닙니다. 2026-03-14 또는 2026-03-14T09:30과 같이 쓰십시오",
                &[("text", text)],
            );
        }
        R::MonitoringProbability { name, value } => {
            return format!("{name}의 값이 {value}입니다. 0보다 큰 확률이어야 하며 유의수준은 0.5 이하입니다");
        }
        R::MonitoringThresholds => "한계값은 0보다 큰 길이이고, 주의 한계는 경보 한계를 넘을 수 없습니다",
        R::CalibrationGrid => "격자는 각 변에 2–1000개의 점이 있어야 합니다",
        R::CalibrationDistance => "거리는 프로젝트 단위로 0보다 큰 유한한 수입니다",
        R::CalibrationPlaces => "사진 안의 위치 1~1000개가 필요합니다",
        R::CalibrationUnmeasured => "이 카메라의 사진에는 조정에 쓰인 관측이 없습니다",
        R::TranslationWithoutDistance => "이동은 방향을 바꾸지 않습니다. 거리를 지정하거나 회전만 제거하십시오",
        R::PhotosOfNoAdjustment => "카메라 두 개만으로는 사진이 없습니다. 회전, 회전과 이동, 또는 없음을 선택하십시오",
        R::NoCameraCovariance => {
            "조정 결과에 이 카메라 매개변수의 표준오차가 없습니다. 일부 매개변수를 추정하고 통계량을 함께 계산하십시오"
        }
        R::RegionWithoutRays => "맞춤 영역에 광선이 너무 적습니다. 영상 전체를 사용하십시오",
        R::CamerasOfTwoSizes => "두 카메라의 영상 크기가 다릅니다",
        R::CamerasApart => "어떤 회전으로도 두 카메라가 맞지 않습니다. 같은 렌즈의 검정 결과가 아닙니다",
        R::EquationsOfAnother => {
            "이 문서의 방정식이 조정 결과의 표준오차와 맞지 않습니다. 로버스트 경중률과 여러 묶음의 분산 성분 없이 현재 문서를 다시 조정하십시오"
        }
        R::CameraOfSeveral => "카메라가 여러 개입니다. 하나를 지정하십시오",
        R::PhotoOfCamera => "이 카메라는 사진마다 내부표정이 따로 있습니다. 사진을 지정하십시오",
        R::CrossParts { given, most } => {
            return format!("나눌 묶음 수가 {given}입니다. 사진은 2–{most}개 묶음으로 나눕니다");
        }
        R::CrossPhotos { given, needed } => {
            return format!(
                "조정에 참여하는 이 카메라의 사진이 {given}매인데, 묶음마다 따로 검정하려면 {needed}매가 필요합니다. 사진을 더 찍으십시오"
            );
        }
        R::CrossPerPhoto => {
            "이 카메라는 사진마다 내부표정이 따로 있습니다. 사진 묶음끼리 비교할 하나의 카메라가 없습니다"
        }
        R::PartFails { part, photos, cause } => {
            return format!(
                "사진 묶음 {part}(사진 {photos}매)만으로는 조정할 수 없습니다. {} 점을 공유하는 사진을 더 찍거나, 각 묶음이 결정할 수 있는 기준계(자유망 또는 모든 사진에 있는 기준점)를 사용하십시오",
                super::errors::sentence(cause)
            );
        }
        R::PartNotConverged { part, photos } => {
            return format!(
                "사진 묶음 {part}(사진 {photos}매)의 조정이 수렴하지 않습니다. 사진을 더 찍거나 추정할 매개변수를 줄이십시오"
            );
        }
        R::ModelsJudgedPlainly => {
            "데이터 스누핑, 로버스트 경중률, 분산 성분은 잘못된 모형의 잔차를 과대오차나 잡음으로 봅니다. 먼저 과대오차를 끄고, 이 옵션들 없이 계산하십시오"
        }
        R::ModelWithoutImages { missing } => {
            return format!(
                "이 모형으로는 영상점 {missing}개의 상이 생기지 않습니다. 이렇게 넓은 화각의 렌즈에는 opencv_fisheye가 필요합니다"
            );
        }
        R::ModelNotConverged => {
            "이 모형의 조정이 수렴하지 않습니다. 렌즈가 모형과 너무 다르거나 망이 모형의 매개변수를 결정하지 못합니다"
        }
        R::ModelNotFitted { model } => {
            return format!("카메라 모형 {model}의 어떤 값으로도 이 카메라의 광선을 나타낼 수 없습니다");
        }
        R::DatumPoints => "기준계에는 한 직선 위에 있지 않은 점이 셋 이상 필요합니다",
        R::NoImage => "점의 상이 생기지 않는 곳에서 반복이 끝났습니다. 초기값을 개선하십시오",
        R::StandardErrorsApart { value, usual } => {
            return format!(
                "이 표준오차는 {value}인데, 이 망의 보통 정확도라면 {usual}입니다. 너무 달라 계산할 수 없으니 자릿수나 단위를 확인하십시오"
            );
        }
        R::PhotoAstray => {
            "이 사진에서 측정한 점 대부분이 사진 뒤나 화면 밖 먼 곳에 있습니다. 위치와 회전을 고치거나 비우고 다시 표정하십시오"
        }
        R::FeaturePoints { needed, given } => {
            return format!(
                "이 조정에서 결정된 점이 {given}개인데 {needed}개가 필요합니다. 점을 추가하거나 더 많은 사진에서 측정하십시오"
            );
        }
        R::FeaturePointMissing { name } => {
            return format!("점 \"{name}\"의 좌표가 이 조정에서 결정되지 않았습니다. 사진 두 매 이상에서 측정하십시오");
        }
        R::FeatureUndetermined => {
            "점들이 한곳, 한 직선이나 한 평면 위에 있거나 그에 너무 가까워 결정되지 않습니다. 떨어진 곳의 점을 추가하십시오"
        }
        R::FeatureUnsettled => {
            "점에 맞추는 계산이 수렴하지 않았습니다. 거의 평평한 면 위의 점에 맞춘 둥근 형상처럼 최소값이 멀리 있습니다. 떨어진 곳의 점을 추가하십시오"
        }
        R::FeatureNotFitted { name } => {
            return format!("\"{name}\": 점에 맞춘 형상이 아닙니다. 직선, 평면, 원, 구, 원통 가운데 고르십시오");
        }
        R::FeatureBroken { name } => return format!("\"{name}\" 형상을 측정할 수 없어 그에 따른 값도 없습니다"),
        R::FeatureNoDirection => "각은 두 방향(직선, 평면, 원, 원통) 사이, 또는 한 점에서 다른 두 점 사이에서 잽니다",
        R::GivenSigma => "주어진 좌표의 표준오차는 0보다 커야 합니다. 경중률이 모두 같으면 비워 두십시오",
        R::Unmodelled { value } => {
            return format!("모형화되지 않은 오차가 {value}입니다. 0 이상의 화소 수여야 합니다");
        }
        R::CommonDiameter { value } => return format!("표적 지름이 {value}입니다. 0보다 큰 유한한 수여야 합니다"),
        R::DiameterBeyondPoints { value, extent } => {
            return format!(
                "표적 지름이 {value}인데 모든 점이 {extent} 안에 있습니다. 점 좌표와 같은 단위로 입력하십시오"
            );
        }

        R::OutsidePicture { name, value, size } => {
            return filled(
                "{name}{name:이|가} {value}입니다. 사진 안의 위치는 0부터 {size}까지입니다",
                &[("name", name), ("value", value), ("size", size)],
            );
        }
        R::NotPixels { name, value } => {
            return filled(
                "{name}{name:이|가} {value}입니다. 양의 화소 수여야 합니다",
                &[("name", name), ("value", value)],
            );
        }
        R::DamagedRow { value } => return format!("v가 {value}입니다. 손상된 파일에서 읽지 못한 행입니다"),
        R::Dithered => {
            "두 가지 밝기만의 점무늬(디더링)로 명암을 나타낸 사진입니다. 변환하면서 경계가 최대 0.5화소 옮겨졌으므로 회색조 원본을 쓰십시오"
        }
        R::AxisRatio { value } => {
            return filled("최소 축비가 {value}입니다. 0.15 이상 1 이하여야 합니다", &[("value", value)]);
        }
        R::DiametersSwapped { min_diameter, max_diameter } => {
            return filled(
                "최소 지름 {min_diameter}{min_diameter:이|가} 최대 지름 {max_diameter}보다 큽니다",
                &[("min_diameter", min_diameter), ("max_diameter", max_diameter)],
            );
        }
        R::Samples { samples, width, height } => {
            return format!("표본 {samples}개로는 {width} × {height} 화소의 사진이 되지 않습니다");
        }

        R::Missing { name } => return filled("{name}{name:이|가} 없습니다", &[("name", name)]),
        R::NotANumber { name, text } => {
            return filled("{name}{name:이|가} 수가 아닙니다: \"{text}\"", &[("name", name), ("text", text)]);
        }
        R::NotPositive { name, value } => {
            return filled("{name}{name:이|가} 양수가 아닙니다: {value}", &[("name", name), ("value", value)]);
        }
        R::NoneOf { name, choices, text } => {
            return filled(
                "{name}{name:은|는} {choices} 가운데 하나여야 합니다: \"{text}\"",
                &[("name", name), ("choices", choices), ("text", text)],
            );
        }
        R::TooLarge { name, text } => {
            return filled("{name}{name:이|가} 너무 큽니다: \"{text}\"", &[("name", name), ("text", text)]);
        }
        R::Scaled { value, factor } => {
            return format!(
                "{value} × {factor}{}",
                "의 값이 문서에 담을 수 있는 범위를 벗어납니다. 아무것도 환산하지 않았습니다"
            );
        }

        R::CannotWriteJson { message } => return format!("JSON으로 쓸 수 없습니다: {message}"),

        R::PitchMissing => "사진좌표는 밀리미터입니다. 카메라에 화소 크기를 주십시오",
        R::ReadingSigma => "사진좌표의 표준오차는 0보다 큰 밀리미터 값이어야 합니다",
        R::TooFewMarks { measured, given, needed } => {
            return format!(
                "측정한 지표 {measured}개, 주어진 지표 {given}개입니다. 유한한 수의 쌍이 {needed}개 이상 필요합니다"
            );
        }
        R::MarksInOnePoint => "사진지표가 모두 한 점에 있습니다",
        R::MarksOnALine => "사진지표가 한 직선 위에 있습니다",
        R::TooFewRadii { radii, distortions, terms } => {
            return format!("반경 {radii}개와 왜곡량 {distortions}개로는 {terms}개 항을 정할 수 없습니다");
        }
        R::RadiiNotFinite => "반경과 왜곡량은 유한한 수여야 하며 모두 0일 수는 없습니다",
        R::RadiiUndetermined { terms } => return format!("이 반경들로는 {terms}개 항을 정할 수 없습니다"),

        R::CodeRing => "코드 고리는 2~24구획이며 비트 수는 구획 수를 넘지 않습니다",

        R::NotOfKind { name, expected: wanted } => return format!("{name}: {}이어야 합니다", expected(*wanted)),
        R::NoSuchOption { name, known } => return format!("\"{name}\" 옵션이 없습니다. 옵션은 {known}입니다"),
        R::Unreadable { name, message } => return format!("{name}: {message}"),
        R::Other(_) => return above::reason(reason),
    };
    plain.to_owned()
}

#[cfg(test)]
mod tests;
