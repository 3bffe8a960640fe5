//! 표적과 그 검출의 문장.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean targets {
    // Targets
    targets: "표적";
    target: "표적";
    targets_none_yet: "밝거나 어두운 원형 표적을 찾아 측정하고, 링 코드가 있으면 이름을 붙입니다.";
    targets_sentence(targets, coded, photos): "사진 {photos}매에서 표적 {targets}개, 그중 코드 표적 {coded}개.";
    targets_coded(targets, coded): "표적 {targets}개, 코드 {coded}개";
    detect: "표적 검출";
    detect_again: "다시 검출";
    detecting: "표적 검출 중";
    polarity: "표적 밝기";
    polarity_both: "밝음과 어두움";
    polarity_bright: "어두운 바탕에 밝음";
    polarity_dark: "밝은 바탕에 어두움";
    channel: "채널";
    channel_grey: "회색조";
    channel_red: "빨강";
    channel_green: "초록";
    channel_blue: "파랑";
    codes: "링 코드";
    codes_auto: "자동";
    codes_none: "없음";
    codes_of(family): "코드: {family}.";
    codes_of_several: "링을 여러 종류의 코드로 읽을 수 있습니다. 어느 종류입니까?";
    codes_different: "모든 링이 한 종류의 코드는 아니어서 이름을 붙이지 않았습니다. 링 코드에서 종류를 고르십시오.";
    code_candidates: "코드 불명확, 후보";
    method: "방법";
    method_least_squares: "최소제곱 정합";
    method_ellipse: "경계 타원 적합";
    method_intensity: "밝기 중심";
    method_gradient: "기울기 가중 중심";
    diameter: "지름";
    diameter_from: "최소 지름, 화소";
    diameter_to: "최대 지름, 화소";
    steepest: "최대 경사";
    steepest_view: "시선과 표적 법선 사이의 최대 각도, 도";
    no_steepest(typed): "\"{typed}\"{typed:은|는} 경사각이 아닙니다. 0도에서 81도 사이의 값을 입력하십시오.";
    click_a_target: "사진의 표적을 누르면 중심과 표준오차를 보입니다.";
    full_axes: "장축·단축";
    rotation: "회전";
    contrast: "대비";
    edge_width: "경계 폭";
    code_not_read: "코드를 읽지 못한 이유";
    code_all_set: "링이 끊김 없이 이어져 있음";
    code_no_code: "이 종류에 없는 비트 배열";
    code_disturbed: "링 위나 옆에 다른 것이 있음";
    code_between_levels: "밝기가 흑백 사이인 구획이 있음";
    code_other_family: "다른 코드 종류의 구획이거나 둘레에 놓인 점일 수 있음";
    code_uncertain: "링이 작거나 흐리거나 호 하나뿐이어서 우연히 코드처럼 보일 수 있음";
    code_several_families: "여러 종류의 코드에 해당함";
    code_unread: "링의 구획이 있을 자리에 타원이 둘 이상 있음. 이 타원들은 표적으로 보지 않음";
    inner_rim: "안쪽 테두리, 중심 간 거리";
    inner_rim_centred: "두 중심이 일치함";
    inner_rim_off: "두 중심의 차이가 표준오차보다 큼. 바깥 테두리를 씀";
    picture_sharpened(percent, radius): "선명화 {percent} %(반경 {radius} px), 이 때문에 표적이 가려지는 곳에서는 되돌림";
    picture_overexposed(percent): "포화 {percent} %, 적합에서 제외함";
    picture_black(percent): "검정 {percent} %, 검출 없음";
    picture_compressed(percent): "JPEG 압축 흔적이 보임(블록 경계 차이 {percent} % 큼), 잡음으로 계산함";
    picture_compressed_uncounted(percent):
        "JPEG 압축 흔적이 보이나(블록 경계 차이 {percent} % 큼) 이 방법의 표준오차에는 반영되지 않아 실제보다 작음(최소제곱 정합을 쓰십시오)";
    picture_noise(noise): "잡음 {noise} 계조, 표준오차 계산에 사용함";
    picture_shared_noise(noise, factor): "잡음 {noise} 계조, 이웃 화소끼리 상관되어 표준오차가 {factor}배로 커짐";
    picture_sentence(what): "이 사진: {what}.";
    measured_on_sites(format, colour, pattern, bits):
        "{format}, {bits}비트: 센서의 {colour} 화소({pattern})만을 보간 없이 하나하나 써서 측정했습니다.";
    measured_between_sites(format, colour, pattern, bits):
        "{format}, {bits}비트: 이 방법에는 보간된 영상이 필요하므로 {colour} 화소({pattern}) 사이를 보간하여 측정했습니다.";
    measured_noise(read, gain): "사진에서 추정한 잡음: 빛이 없을 때 {read}, 분산은 빛 한 단위마다 {gain}씩 커집니다.";
    measured_light_noise(gain): "사진에서 추정한 잡음: 분산은 빛 한 단위마다 {gain}씩 커집니다. 빛이 없을 때의 잡음은 이 사진에서 알 수 없습니다.";
    measured_read_noise(read): "사진에서 추정한 잡음: 밝기와 무관하게 {read}.";
    measured_overexposed(percent): "포화 {percent} %, 적합에서 제외했습니다.";
    measured_hot(count): "핫픽셀 {count}개는 제외했습니다.";
    measured_corrections(names):
        "파일에 렌즈 보정({names})이 적혀 있으나 여기서는 적용하지 않았습니다. 보정된 영상에서 검정한 카메라는 이와 다른 카메라입니다.";
    unread_corrections: "파일에 든 렌즈 보정 목록을 읽을 수 없습니다. 그 보정은 적용하지 않았습니다.";
    corrections_made(names):
        "카메라 메타데이터에 따르면 다음을 보정했습니다: {names}. 이때의 왜곡은 렌즈의 왜곡이 아니라 보정하고 남은 왜곡이며, 줌과 초점에 따라 달라집니다. 검정과 측정을 같은 설정으로 하십시오.";
    corrections_without_distortion(names): "카메라 메타데이터에 따르면 다음을 보정했습니다: {names}. 왜곡은 보정하지 않았습니다.";
    corrections_of_developed(names):
        "카메라 메타데이터는 이 파일에서 현상한 영상에 다음 보정을 요구합니다: {names}. 여기서는 적용하지 않았습니다. 보정된 영상에서 검정한 카메라는 이와 다른 카메라입니다.";
    corrections_off(names): "메타데이터에 보정하지 않았다고 적힌 항목: {names}.";
    correction_of(what, tag): "{what}({tag})";
    correction_auto(what, tag): "{what}(아는 렌즈일 때, {tag})";
    aberration_distortion: "왜곡";
    aberration_lateral_colour: "배율 색수차";
    aberration_vignetting: "비네팅";
    aberration_diffraction: "회절";
    site_red: "적색";
    site_green: "녹색";
    site_blue: "청색";
    site_cyan: "시안";
    site_magenta: "마젠타";
    site_yellow: "황색";
    site_white: "무필터";
    site_emerald: "에메랄드";
    colours_apart: "배율 색수차";
    colours_apart_hint: "렌즈는 적색과 청색을 녹색보다 조금 크거나 작게 맺습니다. 표적을 세 채널에서 모두 측정하면 그 차이를 알 수 있습니다.";
    measure_colours: "적색과 청색 측정";
    measuring_colours: "적색과 청색 측정 중…";
    apart_radius_px: "반경(px)";
    apart_targets: "표적";
    apart_shift_means: "녹색에 대한 이동량(px, 바깥쪽이 양)과 표준오차입니다.";
    apart_negligible: "이동량이 표준오차의 세 배와 0.02 px를 함께 넘는 반경이 없어 무시할 수 있습니다. 조치가 필요 없습니다.";
    apart_in_green: "이 사진은 녹색에서 측정했으므로 좌표에 이 이동이 없습니다. 이 카메라의 사진을 모두 녹색에서 측정하십시오.";
    apart_measure_green: "사진좌표는 이 이동에 대해 보정하지 않습니다. 채널을 녹색으로 바꾸고 이 카메라의 사진을 모두 다시 측정해야 하나의 내부표정으로 나타낼 수 있습니다.";
    apart_too_few(colour, count): "{colour}: 두 채널에서 함께 측정된 표적이 {count}개뿐이라 추정할 수 없습니다";
    apart_outwards: "바깥쪽 px";
    apart_radius(pixels): "반경 {pixels} px까지";
    rejected_here: "이 사진에서 기각";
    reason_too_small: "너무 작음";
    reason_too_large: "너무 큼";
    reason_not_an_ellipse: "타원이 아님";
    reason_too_flat: "너무 납작함";
    reason_low_contrast: "대비 부족";
    reason_touching: "다른 것과 붙음";
    reason_saturated: "포화";
    reason_at_border: "사진 가장자리";
    reason_occluded: "가려짐";
    occluded_share(share): "가장자리의 {share} %. 나머지로 중심을 쟀으며, 이름을 지정해야 사용됩니다";
    occluded_here(n): "일부가 가려진 표적 {n}개는 점선으로 표시되며 이름을 지정해야 사용됩니다.";
    reason_code_ring: "코드 링의 일부";
    reason_no_fit: "적합 실패";
} }
