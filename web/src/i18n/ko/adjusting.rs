//! 조정과 조언, 입력에 대한 질문의 문장.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean adjusting {
    // Adjustment
    adjustment: "광속조정";
    bundle_adjustment: "광속조정";
    adjust_sentence: "표정으로 초기값을 구한 뒤 모든 미지수를 함께 조정합니다.";
    adjusted_sentence(observations, unknowns, redundancy): "관측값 {observations}개, 미지수 {unknowns}개, 잉여도 {redundancy}.";
    adjust_now: "광속조정 실행";
    adjust_again: "다시 조정";
    adjusting: "조정 중";
    what_is_estimated: "추정할 미지수";
    unknowns: "미지수";
    orientation_of(n): "사진 {n}매의 외부표정요소";
    position_and_rotation: "위치와 회전, 추정";
    object_points: "대상점";
    points_all(n): "{n} × 3 좌표";
    points_with_control(n, control): "{n} × 3 좌표, 그중 기준점 {control}개";
    model_brown: "Brown";
    model_opencv: "OpenCV";
    model_opencv_rational: "OpenCV 유리식";
    model_opencv_fisheye: "OpenCV 어안";
    of_model(model, words): "{model}: {words}";
    all_estimated(free): "{free} 추정";
    all_held(held): "{held} 고정";
    estimated_and_held(free, held): "{free} 추정, {held} 고정";
    estimated: "추정";
    initial_value: "초기값";
    observed_with: "사전 표준오차. 비우면 관측값으로 쓰지 않음";
    not_observed: "없음";
    from_what: "사용한 관측값";
    observations: "관측값";
    image_coordinates: "사진좌표";
    median_sigma(sigma): "각 σ로 경중률 부여, 중앙값 {sigma} px";
    control_coordinates: "기준점 좌표";
    iterations: "반복";
    logarithmic: "로그 눈금";
    no_iterations: "반복이 계산되는 대로 여기에 나타납니다.";
    number: "회";
    largest_step: "최대 보정량";
    damping: "감쇠";
    converged: "수렴: 보정량이 한계보다 작습니다.";
    iteration_limit: "최대 반복 횟수에 이르렀으나 수렴하지 않았습니다. 표시된 값은 해가 아닙니다.";
    diverged: "발산: 잔차를 줄이는 보정이 없었습니다. 점 이름, 기준점, 초기값을 확인하십시오.";
    stopped: "요청에 따라 중지했습니다.";

    // Advice
    sigmas_optimistic(sigma0): "사진좌표의 표준오차가 {sigma0}배 작게 주어졌습니다";
    sigmas_optimistic_body: "σ₀는 1이어야 합니다. 잔차에 모형화되지 않은 영향(표적의 평탄도, 조명, 렌즈)이 남았거나, 주어진 표준오차가 너무 작습니다. 결과의 표준오차에는 σ₀가 반영되어 있습니다.";
    more_notes(n): "표정과 맞지 않는 측정 {n}개 더 있음";
    what_lacks: "경고와 권고";
    hold(name): "{name} 고정";
    lacks_control: "기준점을 셋 이상 주거나 다른 기준계를 고르십시오";
    lacks_control_body: "기준점 기준계는 한 직선 위에 있지 않은 알려진 점에서 위치, 자세, 축척을 얻습니다.";
    n_control(n): "기준점 {n}개";
    n_check(n): "검사점 {n}개";
    n_distances(n): "거리 {n}개";
    no_unit: "단위 없음";
    lacks_scale: "두 점 사이 거리를 주십시오";
    lacks_scale_body: "기준점도 거리도 축척을 정하지 않아 결과의 크기가 임의입니다.";
    seen_once(points): "두 번째 사진에서 측정할 점: {points}";
    seen_once_body(point, photo): "점 {point}{point:은|는} 사진 {photo}에만 측정되어 조정에 들어가지 않습니다. 측정은 그대로 남습니다.";
    n_points(n): "점 {n}개";
    n_photos(n): "사진 {n}매";
    photo_without_points(photos): "측정된 점이 없는 사진: {photos}";
    photo_without_points_body: "표정할 수 없어 조정에 들어가지 않습니다. 다른 설정으로 검출하거나 점을 직접 지정하거나 제외하십시오.";
    hold_or_more(name, camera): "카메라 {camera}의 {name}{name:을|를} 고정하거나 이를 정할 사진을 더하십시오";
    hold_alone_body(name, ratio): "{name}{name:은|는} 표준오차의 {ratio}배에 그쳐 0과 유의하게 다르지 않습니다.";
    hold_or_more_body(name, ratio, other): "{name}{name:은|는} 표준오차의 {ratio}배에 그치고 {other}{other:과|와} 상관이 있습니다. 이 망에서는 두 매개변수가 분리되지 않습니다.";
    look_at(point, photo): "사진 {photo}의 점 {point}{point:을|를} 확인하십시오";
    look_at_given(kind, name): "{kind} {name}{name:을|를} 확인하십시오";
    look_at_body(n, w, alpha): "관측 {n}개가 α {alpha} %의 Baarda w 임계값 {w}{w:을|를} 넘습니다. 그중 가장 큰 관측입니다.";
    nothing_lacks: "모든 사진이 연결되고 모든 점이 결정되었습니다";
    nothing_lacks_body: "임계값을 넘는 관측이 없고 모든 매개변수가 결정되었습니다.";
    c_found(camera, value): "카메라 {camera}의 주점거리를 구함: {value}";
    c_assumed(camera, value): "카메라 {camera}의 주점거리 시작값: {value}";
    c_body: "주어진 값이 없어 조정의 시작값으로만 씁니다.";
    photo_not_oriented(photo): "사진 {photo}{photo:을|를} 표정하지 못했습니다";
    photo_no_points: "측정된 점이 없습니다. 다른 설정으로 검출하거나 점을 직접 지정하십시오.";
    photo_too_few(determined, needed): "다른 사진이나 기준점으로 알려진 점이 {determined}개뿐입니다. {needed}개가 필요합니다.";
    photo_disagrees(determined): "점 {determined}개가 서로 맞지 않습니다. 틀린 점 이름나 다른 카메라가 아닌지 확인하십시오.";
    photo_other_group(group): "사진 묶음 {group}에 속하며, 표정된 사진들과 공통점이 부족합니다.";
    c_weak(camera, value): "카메라 {camera}의 주점거리({value})가 약하게 결정됩니다";
    c_weak_body: "고정하거나 표준오차가 있는 관측값으로 주거나, 수렴 촬영과 90° 회전 촬영을 추가하십시오.";
    c_undetermined: "정해지지 않음";
    c_changed(camera, given, value): "카메라 {camera}의 주점거리: 주어진 값 {given}, 사진에서 구한 값 {value}";
    c_changed_body: "대개 렌즈, 줌, 사진 크기가 다른 경우입니다. 아니면 틀린 점 이름이 있는지 확인하십시오.";
    photo_groups(n): "사진이 서로 연결되지 않은 {n}개 묶음으로 나뉩니다";
    photo_groups_body(groups): "공통점을 측정하거나 사이의 사진을 더하십시오. 첫 묶음만 표정되었습니다: {groups}";
    photo_ambiguous(photo): "사진 {photo}의 알려진 점에 두 가지 표정이 똑같이 맞습니다";
    photo_ambiguous_body: "잔차가 작은 쪽을 택했습니다. 다른 점들의 평면 밖에 있는 점을 더 측정하십시오.";
    point_not_determined(point): "점 {point}의 좌표를 정하지 못했습니다";
    point_not_measured: "어느 사진에서도 측정되지 않았습니다.";
    point_too_few(photos): "표정된 사진 {photos}매에서만 측정되었습니다. 두 매가 필요합니다.";
    point_parallel(angle): "광선 교차각이 {angle}°에 불과합니다. 다른 방향에서 찍은 사진에서 측정하십시오.";
    point_behind(photo): "사진 {photo}의 카메라 뒤에 놓입니다. 그 사진의 점 이름을 확인하십시오.";
    point_disagrees: "광선이 교차하지 않습니다. 각 사진의 점 이름을 확인하십시오.";
    point_no_coordinates: "좌표가 없는 기준점 또는 검사점입니다.";
    point_undecided(first, second):
        "광선이 두 위치에서 같은 수로 교차합니다(사진 {first}, 사진 {second}). 두 표적에 같은 점 이름이 붙었습니다. 하나의 이름을 바꾸십시오.";
    measurement_disagrees(point, photo): "사진 {photo}의 점 {point}{point:이|가} 다른 측정과 맞지 않습니다";
    measurement_disagrees_body: "대개 점 이름이 틀린 경우입니다. 확인하여 이름을 바꾸거나 제외하십시오.";
    behind: "뒤쪽";

    // Questions about the input
    exchange_now(how): "바로잡기: {how}";
    exchanging(first, second): "{first}, {second} 좌표 교환";
    negating(axis): "{axis} 좌표 부호 변경";
    mirrored(exchange, exchanged, given):
        "주어진 좌표가 거울상입니다: {exchange} 시 차이가 {given}에서 {exchanged}{exchanged:으로|로} 줄어듭니다";
    mirrored_body: "이 좌표축으로는 모든 검정을 통과해도 좌표가 틀릴 수 있습니다.";
    mirrored_or_body(others):
        "다음과는 사진으로 구별되지 않습니다: {others}. 어느 쪽이든 형상은 같습니다. 이 좌표축으로는 모든 검정을 통과해도 좌표가 틀릴 수 있습니다.";
    undecided_axes: "주어진 점이 한 평면에 있습니다. 좌표축이 맞습니까?";
    undecided_axes_body(normal):
        "평면은 거울상도 똑같이 맞습니다. 이 좌표축이면 카메라는 ({normal}) 쪽에 있습니다. 반대쪽에서 찍었다면 두 축이 바뀌었거나 한 축의 부호가 틀렸습니다.";
    unit_of_distance(bars): "거리 {bars}의 단위가 틀렸습니까?";
    unit_of_control: "기준점의 단위가 틀렸습니까?";
    unit_of_camera(camera): "카메라 {camera}의 주점거리 단위가 틀렸습니까?";
    unit_of_diameters: "좌표와 표적 지름의 단위가 다릅니까?";
    unit_body(ratio, nearest): "다른 자료로 구한 값의 {ratio}배이며, 두 길이 단위의 비는 {nearest}입니다.";
    one_station(photos): "사진 {photos}의 촬영 위치가 같습니다";
    one_station_body: "이 사진들만으로는 깊이를 구할 수 없습니다. 다른 위치에서 찍은 사진을 추가하십시오.";
    one_station_all: "모든 사진의 촬영 위치가 같습니다";
    one_station_all_body: "깊이와 주점거리를 결정할 수 없습니다. 다른 위치에서 사진을 찍으십시오.";
    field_of_view(camera, value): "카메라 {camera}: 주점거리 {value}{value:은|는} 옳은 값일 수 없습니다";
    field_of_view_body: "있을 수 없는 화각이 되므로 이 값을 쓰지 않았습니다.";
    field_of_view_pixels:
        "카메라에 화소 크기가 없어 값이 화소 단위가 되므로 쓰지 않았습니다. 화소 크기나 화소 단위의 값을 주십시오.";
    image_size(camera, photos): "사진 {photos}{photos:이|가} 카메라 {camera}의 영상보다 큽니다";
    image_size_body(size): "카메라의 영상 크기는 {size} px입니다. 사진에 맞는 카메라나 검정값을 고르십시오.";
    photo_resized(photo, camera): "사진 {photo}{photo:은|는} 카메라 {camera}의 영상과 크기가 다릅니다";
    photo_cropped(photo, camera): "사진 {photo}{photo:은|는} 카메라 {camera}의 영상에서 잘라낸 것입니다";
    photo_reframed_body: "표정하지 않았습니다. 원본 파일을 쓰거나 이 사진에 별도의 카메라를 주십시오.";
    photo_other_distance(photo, camera): "사진 {photo}의 주점거리가 카메라 {camera}의 값과 다릅니다";
    photo_other_distance_body: "줌이나 카메라가 다릅니다. 표정하지 않았으므로 이 사진에 별도의 카메라를 주십시오.";
} }
