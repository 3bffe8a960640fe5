//! Why the engine refuses something, in Korean. The English is the engine's own.

mod names;
mod pictures;

use std::fmt::Display;

use sightline::error::Reason;
use sightline::report::texts::particles::after;
use sightline::report::texts::template;

pub use names::{degeneracy, lack, thing};
use names::{expected, photomodeler_part};
pub use pictures::{damage, picture};

/// A sentence whose particles follow its values.
fn told(template: &str, values: &[(&str, &dyn Display)]) -> String {
    template::fill(template, values, after)
}

/// What is not allowed where it stands.
pub fn reason(reason: &Reason) -> String {
    use Reason as R;
    let plain = match reason {
        R::NotADocument => "Sightline 문서가 아닙니다. \"format\": \"sightline\"이 없습니다",
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
        R::NewerVersion { version } => {
            return format!(
                "문서 버전이 {version}입니다. 이 프로그램은 버전 1을 읽으므로 더 새로운 프로그램으로 여십시오"
            );
        }
        R::NoVersion => "문서에 버전이 없습니다",
        R::DamagedDocument { message } => return format!("문서가 손상되었습니다: {message}"),
        R::OneFile { given } => return format!("이 형식은 파일 하나입니다. {given}개를 주었습니다"),
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
        R::PixelPitch => "화소 크기은 0 mm보다 커야 합니다",
        R::ParameterSigma => "매개변수의 사전 표준오차는 0보다 커야 합니다. 고정하려면 비워 두십시오",
        R::FocalLengthTwice => "f는 fx와 fy를 하나로 나타냅니다. f만, 또는 fx와 fy를 추정하십시오",

        R::NoColoursMeasured => "이 카메라의 사진 중 색을 따로 측정한 것이 없습니다. RAW 사진의 색을 따로 측정하십시오",
        R::ColoursOfAnotherGrid { photo } => {
            return format!(
                "사진 \"{photo}\"의 격자가 색을 따로 측정한 다른 사진과 다릅니다. 크기가 같은 사진에서 측정하십시오"
            );
        }
        R::ColoursWithoutDistance => {
            "배율 색수차에는 주점거리가 필요한데 아직 알려져 있지 않습니다. 먼저 표정하거나 조정하십시오"
        }
        R::ColoursBeyondModel { left_px } => {
            return format!(
                "카메라 모형로 나타내지 못한 색수차가 {left_px}화소 남습니다. 왜곡이 영상 안에서 접히거나 렌즈의 왜곡이 아닙니다"
            );
        }

        R::OtherAdjustment => "결과가 프로젝트의 다른 상태에 속합니다. 다시 조정하십시오",
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
            return told(
                "시기 \"{first}\"{first:과|와} 시기 \"{name}\"에 자동 번호가 아닌 공통점이 없습니다. 네 점 이상에 같은 이름을 주십시오",
                &[("first", first), ("name", name)],
            );
        }
        R::EpochReference { name, given, needed } => {
            return told(
                "시기 \"{name}\"{name:과|와} 비교 시기의 공통 기준점이 {given}개이며 {needed}개 이상 필요합니다. 기준점을 더 지정하거나 두 시기에서 모두 측정하십시오",
                &[("name", name), ("given", given), ("needed", needed)],
            );
        }
        R::EpochReferenceLine => {
            "기준점이 한 직선 위에 있어 회전을 결정할 수 없습니다. 직선에서 벗어난 점을 기준점으로 지정하십시오"
        }
        R::EpochReferenceMany { given, limit } => {
            return format!(
                "기준점이 {given}개입니다. 한 번에 {limit}개까지 검정하므로 안정하다고 보는 점만 지정하십시오"
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
        R::EpochDate { text } => {
            return told(
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
        R::GivenSigma => "주어진 좌표의 표준오차는 0보다 커야 합니다. 경중률가 모두 같으면 비워 두십시오",
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
            return told(
                "{name}{name:이|가} {value}입니다. 사진 안의 위치는 0부터 {size}까지입니다",
                &[("name", name), ("value", value), ("size", size)],
            );
        }
        R::NotPixels { name, value } => {
            return told(
                "{name}{name:이|가} {value}입니다. 양의 화소 수여야 합니다",
                &[("name", name), ("value", value)],
            );
        }
        R::DamagedRow { value } => return format!("v가 {value}입니다. 손상된 파일에서 읽지 못한 행입니다"),
        R::Dithered => {
            "두 가지 밝기만의 점무늬(디더링)로 명암을 나타낸 사진입니다. 변환하면서 경계가 최대 0.5화소 옮겨졌으므로 회색조 원본을 쓰십시오"
        }
        R::AxisRatio { value } => {
            return told("최소 축비가 {value}입니다. 0.15 이상 1 이하여야 합니다", &[("value", value)]);
        }
        R::DiametersSwapped { min_diameter, max_diameter } => {
            return told(
                "최소 지름 {min_diameter}{min_diameter:이|가} 최대 지름 {max_diameter}보다 큽니다",
                &[("min_diameter", min_diameter), ("max_diameter", max_diameter)],
            );
        }
        R::Samples { samples, width, height } => {
            return format!("표본 {samples}개로는 {width} × {height} 화소의 사진이 되지 않습니다");
        }

        R::NotText => "UTF-8, UTF-16, CP949 텍스트가 아닙니다. UTF-8 텍스트 파일로 저장하십시오",
        R::Missing { name } => return told("{name}{name:이|가} 없습니다", &[("name", name)]),
        R::MissingField { name, fields } => {
            return told(
                "{name}{name:이|가} 없습니다. 이 행의 항목은 {fields}개입니다",
                &[("name", name), ("fields", fields)],
            );
        }
        R::NotANumber { name, text } => {
            return told("{name}{name:이|가} 수가 아닙니다: \"{text}\"", &[("name", name), ("text", text)]);
        }
        R::NotWhole { name, text } => {
            return told("{name}{name:이|가} 정수가 아닙니다: \"{text}\"", &[("name", name), ("text", text)]);
        }
        R::NotPositive { name, value } => {
            return told("{name}{name:이|가} 양수가 아닙니다: {value}", &[("name", name), ("value", value)]);
        }
        R::Negative { name, value } => {
            return told("{name}{name:이|가} 음수입니다: {value}", &[("name", name), ("value", value)]);
        }
        R::CommaAmongPoints { name, text } => {
            return format!(
                "{name}: 다른 수는 소수점을 쓰는데 쉼표가 있습니다: \"{text}\" (천 단위 구분 없이 쓰십시오)"
            );
        }
        R::PointAmongCommas { name, text } => {
            return format!(
                "{name}: 다른 수는 소수 쉼표를 쓰는데 점이 있습니다: \"{text}\" (천 단위 구분 없이 쓰십시오)"
            );
        }
        R::NoneOf { name, choices, text } => {
            return told(
                "{name}{name:은|는} {choices} 가운데 하나여야 합니다: \"{text}\"",
                &[("name", name), ("choices", choices), ("text", text)],
            );
        }
        R::AmbiguousNumber { name, text, decimal, thousands } => {
            return told(
                "{name}: \"{text}\"{text:은|는} 두 가지로 읽힙니다. 쉼표가 소수점이면 {decimal}, 천 단위 구분이면 {thousands}입니다. 소수점 기호를 고르십시오",
                &[("name", name), ("text", text), ("decimal", decimal), ("thousands", thousands)],
            );
        }
        R::SeparatorBothWays => {
            "필드를 나누는 기호가 소수점이나 천 단위 구분일 수도 있습니다. 표를 세미콜론이나 탭으로 나누어 저장하거나, 소수점을 쓰고 모든 열의 이름을 머리글에 적으십시오"
        }
        R::MoreFields { fields, columns } => {
            return format!("이 행의 필드는 {fields}개인데 머리글의 열은 {columns}개입니다");
        }
        R::HeadingIncomplete { name } => {
            return told(
                "머리글에 {name} 열이 없습니다. 열 이름을 id, X, Y, Z(또는 N, E, H)로 적으십시오",
                &[("name", name)],
            );
        }
        R::HeadingTwice { name } => return told("머리글에 {name} 열이 두 번 나옵니다", &[("name", name)]),
        R::UnitOfCoordinates => "머리글에 표준오차의 단위만 있고 좌표의 단위가 없습니다. 좌표의 단위를 고르십시오",
        R::GeographicHeading => {
            "머리글이 위도와 경도입니다. 조정은 공간 직각좌표로 하므로 먼저 평면좌표(TM, UTM)로 투영하십시오"
        }
        R::GeographicAngle { name, text } => {
            return told(
                "{name}{name:은|는} 각도입니다: \"{text}\". 조정은 공간 직각좌표로 하므로 먼저 평면좌표(TM, UTM)로 투영하십시오",
                &[("name", name), ("text", text)],
            );
        }
        R::ListColumns { needed, columns } => {
            return format!("이 목록의 행에는 열이 적어도 {needed}개 있어야 하는데 {columns}개입니다");
        }
        R::TooLarge { name, text } => {
            return told("{name}{name:이|가} 너무 큽니다: \"{text}\"", &[("name", name), ("text", text)]);
        }
        R::Scaled { value, factor } => {
            return format!(
                "{value} × {factor}{}",
                "의 값이 문서에 담을 수 있는 범위를 벗어납니다. 아무것도 환산하지 않았습니다"
            );
        }
        R::ControlColumns { columns } => {
            return format!("기준점에는 네 열(id, X, Y, Z)이 필요한데 표의 열은 {columns}개입니다");
        }

        R::NameWithFolders => "사진 파일 이름에는 폴더를 넣을 수 없습니다",
        R::Entries { entries, limit } => {
            return format!("압축 파일의 항목이 {entries}개입니다. 프로젝트 파일은 {limit}개까지입니다");
        }
        R::NoProjectInside => "프로젝트 파일이 아닙니다. 압축 안에 project.json이 없습니다",
        R::SameNames => {
            "압축 파일에 이름이 같은 항목이 여럿이어서 어느 것인지 알 수 없습니다. 프로젝트 파일이 아닙니다"
        }
        R::SharedBytes => "압축 파일의 항목들이 같은 바이트를 나눠 씁니다. 프로젝트 파일이 아닙니다",
        R::EntryName => "압축에 든 항목 하나의 이름이 손상되었습니다",
        R::EntrySize => "프로젝트 파일의 이 부분이 손상되었습니다. 적힌 크기와 다릅니다",
        R::TakesTooMuch { megabytes } => return format!("문서가 메모리를 {megabytes} MB보다 많이 차지합니다"),
        R::CannotCarry { name } => {
            return format!("식별자 \"{name}\": 이 형식으로 쓰면 다른 식별자로 읽힙니다. 이름을 바꾸십시오");
        }
        R::DamagedEntry { message } => return format!("프로젝트 파일이 손상되었습니다: {message}"),
        R::Unpacks { megabytes } => {
            return format!("압축을 풀면 {megabytes} MB가 넘습니다. 프로젝트 파일이 아닙니다");
        }
        R::DamagedArchive { message } => {
            return format!("프로젝트 파일이 아니거나 손상되었습니다({message}). 만든 곳에서 다시 저장하십시오");
        }
        R::CannotPack { message } => return format!("프로젝트 파일을 쓸 수 없습니다: {message}"),
        R::CannotWriteJson { message } => return format!("JSON으로 쓸 수 없습니다: {message}"),
        R::CannotWritePicture { message } => return format!("사진을 쓸 수 없습니다: {message}"),

        R::PhotoModelerCut { part } => {
            return format!(
                "PhotoModeler 텍스트 내보내기 파일이 아니거나 중간에 잘렸습니다: {} 없음",
                photomodeler_part(*part)
            );
        }
        R::NoPixels => "사진에 화소가 없습니다",
        R::NotDbat => "DBAT 프로젝트가 아닙니다. document와 input이 없습니다",
        R::NoColumn { column } => return format!("형식에 {column} 열이 없습니다"),
        R::ColumnsNotNamed { file } => return format!("{file}의 열 이름이 없습니다"),
        R::Numbers { name, count, text } => {
            return told(
                "{name}{name:은|는} 수 {count}개여야 합니다: \"{text}\"",
                &[("name", name), ("count", count), ("text", text)],
            );
        }
        R::SizeNotPositive { name } => return format!("{name}의 폭과 높이는 양수여야 합니다"),
        R::LensModel { model } => {
            return told(
                "렌즈 모형 {model}{model:은|는} 이상점을 왜곡합니다. 측정점을 보정하는 모형(1부터)만 읽습니다",
                &[("model", model)],
            );
        }
        R::Skew => "비직교(skew)는 0만 읽습니다",
        R::CamerasNotTold { cameras } => {
            return format!("카메라가 {cameras}대인데 사진에 어느 카메라인지 적혀 있지 않습니다");
        }
        R::Filter { text } => return format!("filter는 keep 또는 remove입니다: \"{text}\""),
        R::DamagedXml { message } => return format!("XML이 손상되었습니다: {message}"),
        R::XmlTooDeep { limit } => return format!("XML 요소가 {limit}단계보다 깊게 겹쳐 있습니다"),
        R::XmlEntity { name } => return format!("XML이 손상되었습니다: 알 수 없는 개체 {name}"),
        R::XmlOpen { name } => {
            return told("XML이 손상되었습니다: {name}{name:이|가} 닫히지 않았습니다", &[("name", name)]);
        }
        R::XmlEmpty => "XML이 손상되었습니다: 비어 있습니다",
        R::DamagedYaml { message } => return format!("YAML이 손상되었습니다: {message}"),
        R::FormatUnrecognised => "파일의 형식을 알 수 없습니다. \"auto\" 대신 형식을 지정하십시오",
        R::ExpectedHere { expected, found } => {
            return format!("여기에는 다음이 있어야 합니다: {expected}. 실제로 있는 것: \"{found}\"");
        }
        R::EndsWhere { expected } => return format!("파일이 도중에 끝났습니다. 이어서 있어야 할 것: {expected}"),
        R::NoSuchCameraModel { model } => {
            return format!(
                "카메라 모형 {model}: 지원하지 않습니다. 다른 프로그램에서 원근 모형(OpenCV, Brown)로 검정하거나 사진의 왜곡을 보정한 뒤 가져오십시오"
            );
        }
        R::ConversionFails { model } => {
            return format!(
                "카메라 모형 {model}: 이 영역에서 변환할 수 없습니다. 사진에서 실제로 사용하는 영역을 지정하십시오"
            );
        }
        R::ConversionTooLarge { max_px } => {
            return format!(
                "두 카메라 모형의 차이가 최대 {max_px}화소입니다. convert 옵션으로 허용하거나 사진에서 실제로 사용하는 영역을 지정하십시오"
            );
        }
        R::RegionShape => "영역은 서로 다른 세 점 이상으로 이루어진 화소 좌표의 다각형이어야 합니다",
        R::CovarianceShape => {
            "공분산에는 이 카메라의 매개변수와, 매개변수마다 행과 열이 하나씩 있는 대칭 양정치 행렬이 있어야 합니다"
        }

        R::PitchMissing => "사진좌표는 밀리미터입니다. 카메라에 화소 크기을 주십시오",
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

        R::Noise => "잡음은 0화소 이상의 표준편차입니다",
        R::Margin => "여백은 화소 수입니다",
        R::Incidence => "최대 입사각은 라디안 각도입니다",
        R::StationNotFinite => "촬영점의 위치와 회전은 유한한 수여야 합니다",
        R::StationAngles => "촬영점의 각은 유한한 수여야 합니다",
        R::StationDirection => "촬영점에는 회전각이나 바라보는 점이 필요합니다",
        R::StationAim => "촬영점은 자신을 바라볼 수 없습니다",
        R::Face { index } => {
            return told(
                "면 {index}{index:은|는} 유한한 밝기와 0보다 큰 결을 가진 평행사변형이 아닙니다",
                &[("index", index)],
            );
        }
        R::Disc => "표적에는 유한한 중심, 방향, 0보다 큰 지름이 필요합니다",
        R::CodeRing => "코드 고리는 2~24구획이며 비트 수는 구획 수를 넘지 않습니다",
        R::Exposure => "노출에는 0.3~10화소의 점확산, 0~1의 비네팅과 잡음, 8 또는 16비트가 필요합니다",

        R::SheetNothing => "인쇄할 것이 없습니다. 코드, 점, 축척 막대 또는 검정판을 지정하십시오",
        R::SheetDiameter { value } => {
            return format!("지름 {value} mm의 점은 인쇄할 수 없습니다. 0.5~400 mm여야 합니다");
        }
        R::SheetRuler { value, length } => {
            return format!("{length} mm 자의 측정값이 {value}입니다. 절반에서 두 배 사이여야 합니다");
        }
        R::SheetBar { value } => return format!("축척 막대 길이가 {value} mm입니다. 0보다 크고 1 km 이하여야 합니다"),
        R::SheetNumbers { text } => return format!("번호 목록이 아닙니다: \"{text}\" (1-20, 35처럼 쓰십시오)"),
        R::SheetNumberUnknown { number, family } => {
            return format!("코드 {number}번은 없습니다. 이 계열의 번호는 1~{family}입니다");
        }
        R::SheetTooManyCodes { wanted, family } => {
            return format!(
                "코드 {wanted}개가 필요한데 이 계열에는 {family}개가 있습니다. 수를 줄이거나 비트 수가 큰 계열을 고르십시오"
            );
        }
        R::SheetTooManyTargets { limit } => return format!("표적이 {limit}개를 넘습니다. 나누어 인쇄하십시오"),
        R::SheetTooMany { limit } => return format!("{limit}장을 넘습니다. 나누어 인쇄하십시오"),
        R::SheetNoRoom { value, width, height } => {
            return format!(
                "지름 {value} mm의 점과 그 여백은 {width} x {height} mm 용지에 들어가지 않습니다. 용지를 키우거나 점을 줄이십시오"
            );
        }
        R::SheetAdvice => "주점거리, 거리, 지름은 0보다 크고 각은 89°보다 작아야 합니다",

        R::PlanCamera => "촬영 계획에는 카메라가 필요합니다",
        R::FormTooMany { limit } => return format!("한 형상의 표적은 {limit}개까지입니다. 열이나 행을 줄이십시오"),
        R::PlanTooLarge { limit } => {
            return format!("표적 수와 사진 수의 곱이 {limit}을 넘습니다. 대상물을 나누어 계획하십시오");
        }
        R::PlanLeastPixels => "가장 작은 표적은 0 이상의 화소 수입니다",
        R::PlanWanted => "목표 정밀도는 0보다 큰 길이이고 확률은 0.5에서 0.999까지입니다",
        R::PlanLens => "조리개값, 초점거리 설정, 허용 착란원은 0보다 커야 합니다",
        R::PlanNothingSeen => {
            "이 카메라로는 표적 네 개를 볼 수 있는 촬영점이 없습니다. 더 큰 표적, 더 긴 렌즈가 필요하거나 금지 구역을 줄여야 합니다"
        }

        R::ImageNoise => "사진좌표의 표준편차는 0.01에서 1000 µm까지입니다",
        R::PixelNoise => "화소 잡음은 최댓값의 0에서 0.2까지입니다",
        R::ControlSigma => "기준점 좌표의 표준오차는 1e-6에서 1000 mm까지입니다",
        R::Rounds { limit } => return format!("몬테카를로 반복은 {limit}회까지입니다"),

        R::NotOfKind { name, expected: wanted } => return format!("{name}: {}이어야 합니다", expected(*wanted)),
        R::NoSuchOption { name, known } => return format!("\"{name}\" 옵션이 없습니다. 옵션은 {known}입니다"),
        R::Unreadable { name, message } => return format!("{name}: {message}"),
    };
    plain.to_owned()
}

#[cfg(test)]
mod tests;
