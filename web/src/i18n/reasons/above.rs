//! Reasons of the crates above the engine, in Korean.

use sightline::error::Reason;
use sightline_exchange::reason::ExchangeReason;
use sightline_lab::reason::LabReason;
use sightline_plan::reason::PlanReason;
use sightline_report::reason::ReportReason;

use super::filled;
use super::names::photomodeler_part;

/// The Korean sentence.
pub fn reason(reason: &Reason) -> String {
    let known = ExchangeReason::of(reason).map(|reason| exchange(&reason));
    let known = known.or_else(|| PlanReason::of(reason).map(|reason| plan(&reason)));
    let known = known.or_else(|| ReportReason::of(reason).map(|reason| report(&reason)));
    known.or_else(|| LabReason::of(reason).map(|reason| lab(&reason))).unwrap_or_else(|| reason.to_string())
}

fn exchange(reason: &ExchangeReason) -> String {
    use ExchangeReason as R;
    let plain = match reason {
        R::NotADocument => "Sightline 문서가 아닙니다. \"format\": \"sightline\"이 없습니다",
        R::NewerVersion { version } => {
            return format!(
                "문서 버전이 {version}입니다. 이 프로그램은 버전 1을 읽으므로 더 새로운 프로그램으로 여십시오"
            );
        }
        R::NoVersion => "문서에 버전이 없습니다",
        R::OneFile { given } => return format!("이 형식은 파일 하나입니다. {given}개를 주었습니다"),
        R::NotText => "UTF-8, UTF-16, CP949 텍스트가 아닙니다. UTF-8 텍스트 파일로 저장하십시오",
        R::MissingField { name, fields } => {
            return filled(
                "{name}{name:이|가} 없습니다. 이 행의 항목은 {fields}개입니다",
                &[("name", name), ("fields", fields)],
            );
        }
        R::NotWhole { name, text } => {
            return filled("{name}{name:이|가} 정수가 아닙니다: \"{text}\"", &[("name", name), ("text", text)]);
        }
        R::Negative { name, value } => {
            return filled("{name}{name:이|가} 음수입니다: {value}", &[("name", name), ("value", value)]);
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
        R::AmbiguousNumber { name, text, decimal, thousands } => {
            return filled(
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
            return filled(
                "머리글에 {name} 열이 없습니다. 열 이름을 id, X, Y, Z(또는 N, E, H)로 적으십시오",
                &[("name", name)],
            );
        }
        R::HeadingTwice { name } => return filled("머리글에 {name} 열이 두 번 나옵니다", &[("name", name)]),
        R::UnitOfCoordinates => "머리글에 표준오차의 단위만 있고 좌표의 단위가 없습니다. 좌표의 단위를 고르십시오",
        R::GeographicIncomplete { name } => {
            return filled(
                "머리글에 위도나 경도는 있지만 {name} 열이 없습니다. 위도, 경도, 타원체고가 모두 필요합니다",
                &[("name", name)],
            );
        }
        R::GeographicOrigin => {
            "위도와 경도로 된 목록입니다. 함께 쓰는 모든 목록에 같은 국지 좌표계 원점(local_system)을 지정하십시오"
        }
        R::PlaneAndGeographic { name } => {
            return filled(
                "위도, 경도와 함께 {name} 열이 선택되어 있습니다. 둘 중 한 좌표계만 고르십시오",
                &[("name", name)],
            );
        }
        R::AngleUnexpected { name, text } => {
            return filled("길이가 와야 할 {name}에 각도가 있습니다: \"{text}\"", &[("name", name), ("text", text)]);
        }
        R::NotAnAngle { name, text } => {
            return filled(
                "{name}{name:이|가} 도 단위의 각도가 아닙니다: \"{text}\"",
                &[("name", name), ("text", text)],
            );
        }
        R::AngleForm { name, text } => {
            return filled(
                "{name}의 표기가 목록의 다른 각도와 다릅니다(십진 도 또는 도·분·초): \"{text}\"",
                &[("name", name), ("text", text)],
            );
        }
        R::AngleDirection { name, text } => {
            return filled("{name}에 다른 축의 방향 문자가 있습니다: \"{text}\"", &[("name", name), ("text", text)]);
        }
        R::AngleOutside { name, text, limit } => {
            let limit = limit.to_string();
            return filled(
                "{name}{name:이|가} ±{limit}° 범위를 벗어납니다: \"{text}\"",
                &[("name", name), ("text", text), ("limit", &limit)],
            );
        }
        R::ListColumns { needed, columns } => {
            return format!("이 목록의 행에는 열이 적어도 {needed}개 있어야 하는데 {columns}개입니다");
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
            return filled(
                "{name}{name:은|는} 수 {count}개여야 합니다: \"{text}\"",
                &[("name", name), ("count", count), ("text", text)],
            );
        }
        R::SizeNotPositive { name } => return format!("{name}의 폭과 높이는 양수여야 합니다"),
        R::LensModel { model } => {
            return filled(
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
            return filled("XML이 손상되었습니다: {name}{name:이|가} 닫히지 않았습니다", &[("name", name)]);
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
        R::PhotoSize { name } => {
            return filled(
                "파일에 영상 크기가 없고 사진 \"{name}\"의 크기를 알 수 없습니다. 먼저 그 사진을 프로젝트에 추가하거나 파일과 함께 주십시오",
                &[("name", name)],
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
    };
    plain.to_owned()
}

fn plan(reason: &PlanReason) -> String {
    use PlanReason as R;
    let plain = match reason {
        R::CannotWritePicture { message } => return format!("사진을 쓸 수 없습니다: {message}"),
        R::Noise => "잡음은 0화소 이상의 표준편차입니다",
        R::Margin => "여백은 화소 수입니다",
        R::Incidence => "최대 입사각은 라디안 각도입니다",
        R::StationNotFinite => "촬영점의 위치와 회전은 유한한 수여야 합니다",
        R::StationAngles => "촬영점의 각은 유한한 수여야 합니다",
        R::StationDirection => "촬영점에는 회전각이나 바라보는 점이 필요합니다",
        R::StationAim => "촬영점은 자신을 바라볼 수 없습니다",
        R::Face { index } => {
            return filled(
                "면 {index}{index:은|는} 유한한 밝기와 0보다 큰 결을 가진 평행사변형이 아닙니다",
                &[("index", index)],
            );
        }
        R::Disc => "표적에는 유한한 중심, 방향, 0보다 큰 지름이 필요합니다",
        R::Exposure => "노출에는 0.3~10화소의 점확산, 0~1의 비네팅과 잡음, 8 또는 16비트가 필요합니다",
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
    };
    plain.to_owned()
}

fn report(reason: &ReportReason) -> String {
    use ReportReason as R;
    let plain = match reason {
        R::OtherAdjustment => "결과가 프로젝트의 다른 상태에 속합니다. 다시 조정하십시오",
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
    };
    plain.to_owned()
}

fn lab(reason: &LabReason) -> String {
    use LabReason as R;
    let plain = match reason {
        R::ImageNoise => "사진좌표의 표준오차는 0.01에서 1000 µm까지입니다",
        R::PixelNoise => "화소 잡음은 최댓값의 0에서 0.2까지입니다",
        R::ControlSigma => "기준점 좌표의 표준오차는 1e-6에서 1000 mm까지입니다",
        R::Rounds { limit } => return format!("몬테카를로 반복은 {limit}회까지입니다"),
    };
    plain.to_owned()
}
