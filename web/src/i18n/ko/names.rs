//! 점 이름: 코드, 수동 표시, 정합의 문장.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean names {
    // Identities
    identities: "점 이름";
    identities_sentence(named, points, single): "점 {points}개에 관측 {named}개. 한 사진에만 있는 점 {single}개.";
    open_marks: "측정값 파일 열기…";
    matching: "정합 중";
    matched(found, doubtful): "비코드 표적 관측 {found}개를 정합했습니다. 의심스러운 표적 {doubtful}개는 이름 없이 두었습니다.";
    control: "기준점";
    id: "점 이름";
    rays: "광선";
    role: "구분";
    role_tie: "결합점";
    role_control: "기준점";
    role_check: "검사점";
    doubt: "의심 사유";
    doubt_duplicate(photo): "사진 {photo}에서 코드가 두 번 읽힘";
    doubt_code_family(photo): "사진 {photo}의 코드 종류를 알 수 없음";
    doubt_code_unclear(photo): "사진 {photo}에서 코드가 뚜렷하지 않음";
    doubt_occluded(photo): "사진 {photo}에서 일부가 가려져 중심이 정밀하지 않음";
    doubt_ambiguous(photo): "사진 {photo}에서 후보가 여럿";
    doubt_disagrees(photo): "사진 {photo}의 광선이 나머지와 맞지 않음";
    one_ray: "한 사진에만 있음";
    no_ray: "측정되지 않음";
    points: "점";
    point: "점";
    points_column: "점";
    photo: "사진";
    named_of(named, targets): "표적 {targets}개 중 {named}개 식별";
    name_this_target: "이 표적의 점 이름";
    take_name: "적용";
    marks: "측정값";
    snap_radius: "스냅 반경";
    snapped_sentence(good, all): "측정값 {all}개 가운데 {good}개가 측정된 중심과 일치합니다.";
    take_marks(n): "측정값 {n}개 가져오기";
    why_not: "이유";
    unsnapped_no_detection: "이 사진에서 표적을 검출하지 않음";
    unsnapped_no_target: "반경 안에 표적 없음";
    unsnapped_contested(points): "{points}{points:과|와} 같은 표적에 비슷하게 가까움";
    unsnapped_twice: "이 사진에서 두 번 측정됨";
    remove_point: "점 삭제";
    remove_observation: "관측 삭제";
    take_part_short: "포함";
    placed_by_hand: "직접 지정한 위치를 σ 0.5 px로 적용했습니다.";
    nothing_to_measure: "여기에는 측정할 표적이 없습니다. Alt를 누른 채 누르거나 '자유 지정'을 켜면 누른 위치를 그대로 씁니다.";
    place_freely: "자유 지정";
    place_freely_how: "누른 위치를 그대로 σ 0.5 px로 씁니다. Alt를 누른 채 눌러도 됩니다";
    click_measures: "누르면 측정, Alt+누르기는 자유 지정";
    name_this_place: "이 위치의 점 이름";
    no_name: "이름 없음";
    rename_where: "적용 범위";
    in_all_photos(n): "사진 {n}매 모두";
    in_this_photo(photo): "사진 {photo}에서만";
    rename_says(n): "새 이름은 이 점의 사진 {n}매 모두에 적용됩니다. 다른 점의 이름을 쓰면 두 점이 하나가 됩니다.";
    rename_here_says(photo): "사진 {photo}의 관측에만 새 이름을 주고 다른 사진은 그대로 둡니다.";
    point_renamed(from, to, n): "점 {from}의 이름을 사진 {n}매에서 {to}{to:으로|로} 바꾸었습니다.";
    points_joined(from, to, n): "점 {from}{from:과|와} {to}{to:을|를} 사진 {n}매의 한 점 {to}{to:으로|로} 합쳤습니다.";
    name_taken_from(before, photo, point):
        "사진 {photo}의 이 위치는 점 {before}에서 {point}{point:으로|로} 바뀌었습니다. 다른 사진의 {before}{before:은|는} 그대로입니다.";
    name_moved(point, photo): "사진 {photo}에서 점 {point}의 이전 위치는 이제 이름이 없습니다.";
    point_went(point): "점 {point}{point:은|는} 다른 관측이 없어 마지막 관측과 함께 지웠습니다.";
    both_in_photo(from, to, photo): "사진 {photo}에 {from} 점과 {to} 점이 모두 있어 한 점이 될 수 없습니다.";

    // Measuring by hand
    measuring_by_hand: "수동 측정";
    point_by_point: "점별 측정";
    point_by_point_how: "클릭할 때마다 점을 측정하고, 그 점이 보일 다음 사진으로 넘어갑니다 (M)";
    click_next_point: "다음 점을 클릭하십시오.";
    click_point_here(point): "이 사진에서 점 {point}{point:을|를} 클릭하십시오.";
    point_is_measured_here(point): "점 {point}{point:은|는} 이 사진에서 이미 측정했습니다.";
    is_it(point, off, reach): "이 표적이 점 {point}입니까? 예측 위치에서 {off} px 떨어져 있습니다 (3σ {reach} px).";
    is_it_of_two(point, off, reach, second):
        "이 표적이 점 {point}입니까? 예측 위치에서 {off} px 떨어져 있고 (3σ {reach} px), 또 하나는 {second} px 떨어져 있습니다.";
    is_it_near(point, off): "이 표적이 점 {point}입니까? 예측 위치에서 {off} px 떨어져 있습니다. 예측의 표준오차는 사진을 조정한 뒤에 알 수 있습니다.";
    should_be_near(point): "점 {point}의 예측 위치입니다. 예측의 표준오차는 사진을 조정한 뒤에 알 수 있습니다. 여기서 측정합니까?";
    should_be_here(point, reach): "점 {point}의 예측 위치입니다 (3σ {reach} px). 여기서 측정합니까?";
    yes: "예";
    next_place: "다음 사진";
    next_point: "다음 점";
    in_all_it_should_be: "이 점은 보여야 할 모든 사진에서 측정되었습니다.";
    this_point_in_photos: "사진별로 본 이 점";
    predicted: "예측";
    off_by(px): "{px} px 벗어남";
    not_in(n): "사진 {n}매에는 없음";
    layers: "표시 항목";
    layer_ellipses: "타원";
    layer_names: "점 이름";
    layer_predicted: "예측 위치";
    layer_epipolar: "에피폴라선";
    layer_residuals: "잔차";
    layer_pixels: "화소 격자와 밝기값";
    residual_factor: "잔차 확대 배율";
    times(n): "{n}배";
    brightness: "밝기";
    picture_contrast: "대비";
    as_it_is: "원래대로";
} }
