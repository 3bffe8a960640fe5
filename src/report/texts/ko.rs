//! The report in Korean, as the field speaks: 광속조정, 표정, 잔차, 표준오차, 자유망.
//!
//! `{n}` is a value; `{n:을|를}` is the particle that follows it, as it is read.

use super::particles::after as choose;
use super::translate;

/// This language.
pub struct Korean;

translate! { Korean {
    // The report
    report_title: "광속조정 보고서";
    all_sigmas(unit): "별도 표기가 없으면 σ는 1σ; {unit}";
    operator: "측정자";
    date: "날짜";
    project: "프로젝트";
    chi_squared: "χ², 구간";
    redundancy: "잉여도";
    relative_accuracy: "상대정확도";
    yes: "예";
    no: "아니요";

    // Sections
    summary: "요약";
    uncertainty: "좌표의 불확도";
    observations_and_unknowns: "관측값과 미지수";
    cameras: "카메라";
    network: "관측망";
    photos: "사진";
    points: "점";
    control_check_scale: "기준점, 검사점, 축척";
    lengths: "길이 측정 오차";
    statistics: "통계와 검정";
    residuals: "사진별 잔차";
    left_out: "제외한 것과 그 까닭";
    settings: "설정과 입력 자료";
    all_observations: "전체 영상 관측값";

    // Summary
    measured(points, photos, cameras): "카메라 {cameras}대의 사진 {photos}매에서 {points}점을 광속조정으로 결정하였습니다.";
    measured_self_calibrating(points, photos, cameras): "카메라 {cameras}대의 사진 {photos}매에서 {points}점을 자체검정 광속조정으로 결정하였습니다.";
    datum_control(n, points): "좌표계는 기준점 {n}점({points})의 것입니다.";
    datum_free: "자유망이며, 모든 점의 내적 제약으로 초기값의 평균 위치, 자세, 크기를 유지합니다.";
    datum_free_chosen(n): "자유망이며, 고른 {n}점의 내적 제약으로 초기값의 평균 위치, 자세, 크기를 유지합니다.";
    datum_minimal: "좌표계는 망에 필요한 최소 제약으로 정하였으며, 표준오차는 제약에서 멀수록 커집니다.";
    scale_control: "축척은 기준점에서 얻었습니다.";
    scale_distances(n): "축척은 측정한 거리 {n}개에서 얻었습니다.";
    scale_none: "축척이 없습니다. 거리나 기준점을 주십시오. 길이는 서로의 비율로만 옳으며 단위가 없습니다.";
    test_passed(sigma0, percent): "사후 단위중량 표준오차는 {sigma0}이며 유의수준 {percent} %의 전체 모형 검정을 통과하였습니다. 관측값이 가정한 정확도와 일치합니다.";
    test_too_large(sigma0, percent): "사후 단위중량 표준오차는 {sigma0}이며 유의수준 {percent} %의 전체 모형 검정을 통과하지 못하였습니다. 관측값이 가정보다 나쁘며, 모든 표준오차는 그만큼 크게 잡았습니다.";
    test_too_small(sigma0, percent): "사후 단위중량 표준오차는 {sigma0}이며 유의수준 {percent} %의 전체 모형 검정을 통과하지 못하였습니다. 관측값이 가정보다 좋으며, 모든 표준오차는 그만큼 작게 잡았습니다.";
    standard_errors_estimated(factors): "표준오차를 잔차에서 추정하였습니다: {factors}. 따라서 사후 단위중량 표준오차는 1이 되며, 관측값이 가정만큼 좋은지 전체 모형 검정으로 알 수 없습니다.";
    not_converged: "조정이 수렴하지 않았으므로 이 수치는 결과가 아닙니다.";
    nothing_checked: "잉여도가 없어 관측값을 점검할 수 없습니다.";
    known_to(value, k, percent): "좌표의 평균 불확도는 {value}입니다(k = {k}, 약 {percent} %).";
    least_certain(point, axis, value): "가장 불확실한 좌표는 점 {point}의 {axis}: ± {value}.";
    within_the_network: "망 안에서 좌표 하나하나에 대한 값이며, 포함한 것과 포함하지 않은 것은 불확도 항목에 적었습니다.";
    no_statistics: "통계 없이 조정하여 정확도를 말할 수 없습니다.";
    check_points_agree(n, rms): "미리 알고 있으나 쓰지 않은 검사점 {n}점과의 차이는 {rms}입니다(전 축 RMS).";
    no_independent_check: "검사점이 없으므로 이 좌표에 대한 독립적인 점검은 없습니다.";
    nothing_left_out: "제외한 측정값은 없습니다.";
    not_used(parts): "사용하지 않음: {parts}.";
    left_of_observations(n, of): "영상 관측값 {of}개 중 {n}개";
    left_of_control(n, of): "기준점 {of}점 중 {n}점";
    left_of_coordinates(n): "주어진 좌표 {n}개";
    left_of_distances(n, of): "거리 {of}개 중 {n}개";
    left_of_photos(n, of): "사진 {of}매 중 {n}매";
    left_of_points(n, of): "대상점 {of}점 중 {n}점";
    left_of_parameters(n): "카메라 변수 {n}개";
    left_named(names): "주요 항목: {names}.";
    left_out_short: "사용하지 않음";
    pixels(n): "{n} px";
    left_out_by: "제외한 단계";
    image_observation: "영상 관측값";
    control_point: "기준점";
    by_orientation: "표정";
    by_matching: "정합";
    by_snooping: "데이터 스누핑";
    by_robust: "강인 가중치";
    by_document: "문서";
    by_adjustment: "조정";
    out_gross_error: "과대오차";
    out_no_weight: "가중치가 남지 않음";
    out_photo_disabled: "사진이 문서에서 사용 안 함으로 되어 있음";
    out_not_measured: "사용한 사진에서 측정되지 않음";

    // Uncertainty
    gum_statement(u, k, expanded, percent): "좌표의 합성표준불확도는 u = {u}입니다(모든 점과 축의 RMS). 확장불확도는 포함인자 k = {k}일 때 U = k u = ± {expanded}이며, 정규분포에서 신뢰수준은 약 {percent} %입니다. 측정불확도 표현 지침(JCGM 100:2008, 7.2)에 따라 적었습니다.";
    gum_included: "포함한 것";
    gum_not_included: "포함하지 않은 것";
    gum_image(sigma): "영상좌표: 사전 표준오차 {sigma} px(중앙값).";
    gum_unmodelled(sigma): "카메라 모형이 설명하지 못하는 부분: {sigma} px, 모든 영상좌표의 분산에 더하였습니다.";
    gum_estimated(factors): "위 표준오차를 잔차에서 추정(A형): {factors}.";
    gum_sigma0(sigma0, r): "관측값 사이의 일치: 자유도 {r}에서 σ₀ = {sigma0}(A형 평가). 모든 표준오차에 곱하였습니다.";
    gum_cameras(names): "점과 함께 추정한 카메라 매개변수: {names}.";
    gum_control(n, sigma): "표준오차 {sigma}인 기준점 좌표 {n}개(B형 평가).";
    gum_scale(n, sigma): "축척: 표준오차 {sigma}인 거리 {n}개(B형 평가).";
    gum_scale_relative(ppm, value): "거리만으로 정한 축척의 불확도는 백만분의 {ppm}(1σ)이며, 최대 치수에서는 {value}입니다.";
    gum_no_scale: "축척: 주는 측정값이 없으므로 길이의 소급성이 없습니다.";
    gum_control_held(points): "표준오차 없이 고정한 기준점({points})의 오차: 그대로 결과에 들어갑니다.";
    gum_cameras_held(cameras): "주어진 값으로 고정한 카메라({cameras})의 오차.";
    gum_temperature: "온도: 측정 시와 기준 온도 사이의 대상물과 기준척의 팽창.";
    gum_targets: "표적의 두께와 부착: 좌표는 표적 중심의 것이며 그 아래 표면의 것이 아닙니다.";
    gum_movement: "촬영 중 대상물의 움직임과 변형.";
    gum_systematic: "모든 사진에 공통이며 카메라 모형이 나타내지 못하는 계통오차. 검사점과 검사 길이로 드러납니다.";

    // Observations
    counts: "수";
    precision_and_checks: "정밀도와 점검";
    observations: "관측값";
    image_coordinates: "영상좌표";
    control_coordinates: "기준점 좌표";
    observed_centres: "투영중심";
    distances: "거리";
    observed_parameters: "카메라 매개변수";
    unknowns: "미지수";
    datum_constraints: "기준계 제약";
    iterations: "반복";
    rms_sigma_xyz(unit): "RMS σ X, Y, Z ({unit}, 1σ)";
    largest_dimension(unit): "최대 치수 ({unit})";
    largest_sigma(point, axis, unit): "최대 σ, 점 {point}, {axis} ({unit})";
    rms_residual_px: "영상 잔차 RMS (px)";
    check_rms(n, unit): "검사점 {n}점 RMS ({unit})";
    over_w(limit): "{limit} 초과 |w| 관측값";

    // Cameras
    camera: "카메라";
    model_brown: "Brown 모형, 측정점의 보정";
    model_opencv: "OpenCV 모형, 이상점의 왜곡";
    pitch_unknown: "미상";
    camera_line(size, pitch, n): "센서 격자 {size}, 화소 {pitch}, 사진 {n}매.";
    parameter: "매개변수";
    value: "값";
    unit: "단위";
    ratio: "|값| / σ";
    held: "고정";
    held_at_zero(names): "추정하지 않고 0으로 둔 것: {names}.";
    correlated(limit, pairs): "상관 {limit} 초과: {pairs}. 이 매개변수들은 함께만 알려지며 따로는 불확실합니다.";
    principal_distance: "주점거리";
    principal_point: "주점";
    radial_distortion: "방사왜곡";
    decentring_distortion: "편심왜곡";
    affinity: "축척차";
    shear: "전단";
    lateral_colour: "배율 색수차";
    lateral_colour_means(corner): "녹색에 대한 적색과 청색의 차이로, 바깥쪽이 양(+)이며 사진 모서리(중심에서 {corner} px)에서의 값입니다. 측정한 색이 아닌 다른 색이 얼마나 벗어나는지를 나타내며, 카메라가 그 색의 값을 갖지 않는 한 좌표 보정에는 쓰지 않습니다.";
    colours_held: "다른 색에서의 내부표정";
    colours_held_means(photos): "녹색이나 회색조가 아닌 색에서 측정한 사진에 대해 위 매개변수에 더하는 값이며, 조정에서 고정합니다. 그렇게 측정한 사진 수: {photos}.";
    colour_without_set(colour, photos): "다른 색({colour})에서 측정했으나 카메라가 그 색의 값을 갖고 있지 않아 카메라 자체의 색으로 계산한 사진: {photos}.";
    colour: "색";
    red: "적색";
    blue: "청색";
    at_corner: "모서리";
    targets: "표적";

    // Network
    network_line(photos, points, mean, fewest): "사진 {photos}매가 {points}점을 봅니다. 점마다 광선은 평균 {mean}개, 최소 {fewest}개입니다.";
    points_by_rays: "광선 수별 점";
    weakest_points: "가장 약한 점";
    rays: "광선";
    point: "점";
    weaknesses: "망의 약점";
    no_weakness: "망에서 약한 곳을 찾지 못하였습니다.";
    weak_correlation(camera, first, second, r): "카메라 {camera}: {first} – {second} 구별이 어렵습니다(상관 {r}).";
    weak_redundancy(n): "관측값 {n}개는 다른 관측값으로 거의 점검되지 않습니다.";
    weak_two_rays(n, points): "{n}점은 광선이 둘뿐입니다({points}). 에피폴라선 방향의 오차는 드러나지 않습니다.";
    weak_narrow(n, points): "{n}점의 광선이 좁은 각으로 만납니다({points}).";
    weak_behind(pairs): "본다고 한 사진의 뒤에 있는 점: {pairs}.";
    weak_distance_unused(pairs): "끝점이 측정되지 않아 쓰지 못한 거리: {pairs}.";
    weak_principal_distance(camera, value, sigma): "카메라 {camera}: 주점거리가 잘 결정되지 않습니다({value} ± {sigma}).";
    weak_unsettled: "과대오차 탐색이 끝나지 않았습니다.";
    weak_components: "분산요소 추정이 끝나지 않았습니다.";
    weak_sigmas(sigma0): "잔차가 영상좌표의 표준오차보다 큽니다(σ₀ {sigma0}).";
    weak_unmodelled(sigma0): "모형화되지 않은 부분이 다른 가중치의 것입니다(σ₀ {sigma0}).";
    weak_insignificant(camera, name, ratio): "카메라 {camera}: {name} 값은 표준오차의 {ratio}배로 0과 구별되지 않습니다.";
    weak_suspected(n, names): "관측값 {n}개가 과대오차로 의심됩니다: {names}.";
    control_misfit(point, size, sigmas, axis): "기준점 {point}의 좌표가 사진에서 구한 위치와 {size}({sigmas} 시그마) 다릅니다. 주로 {axis} 방향입니다.";
    exchanged_points(a, b): "기준점 {a}{a:과|와} {b}의 좌표가 서로 바뀐 것으로 보입니다.";
    double_points(n, pairs): "표준오차로 구분되지 않을 만큼 가까운 점 {n}쌍: {pairs}.";
    no_unit: "단위 없음";
    exchanging(first, second): "{first}, {second} 좌표 교환";
    negating(axis): "{axis} 좌표 부호 변경";
    weak_mirrored(exchange, exchanged, given): "주어진 좌표가 거울상입니다. {exchange} 시 차이가 {given}에서 {exchanged}{exchanged:으로|로} 줄어듭니다.";
    weak_undecided(n): "주어진 {n}점이 한 평면에 있어 좌표축이 거울상인지 알 수 없습니다.";
    weak_unit_control(ratio, nearest): "기준점의 크기가 거리에서 얻은 크기의 {ratio}배로 {nearest}배에 가깝습니다. 단위가 틀렸습니까?";
    weak_unit_distance(bars, ratio, nearest): "거리 {bars}의 값이 망에서의 길이의 {ratio}배로 {nearest}배에 가깝습니다. 단위가 틀렸습니까?";
    weak_unit_camera(camera, ratio, nearest): "카메라 {camera}: 주어진 주점거리가 사진에서 얻은 값의 {ratio}배로 {nearest}배에 가깝습니다. 단위가 틀렸습니까?";
    weak_unit_diameter(nearest): "망의 크기와 타깃 지름이 약 {nearest}배 차이 납니다. 단위가 틀렸습니까?";
    weak_one_station(photos): "사진 {photos}의 촬영 위치가 같아 서로 깊이를 주지 못합니다.";
    weak_one_station_all(n): "사진 {n}매를 모두 한 자리에서 찍어 깊이와 주점거리를 결정할 수 없습니다.";
    weak_view(camera, value, angle): "카메라 {camera}: 주점거리 {value}에 따른 화각이 {angle}°입니다.";
    weak_view_pixels(camera, value, angle): "카메라 {camera}: 주점거리 {value} px에 따른 화각이 {angle}°입니다. 밀리미터 값이면 화소 크기가 필요합니다.";
    weak_image_size(camera, size, photos, measured): "카메라 {camera}의 영상 크기는 {size} px이지만 사진 {photos}에는 {measured} px까지 관측값이 있습니다.";
    weak_resized(photo, camera, factor): "사진 {photo}의 크기가 바뀌었습니다. 카메라 {camera} 영상의 {factor}배입니다.";
    weak_cropped(photo, camera, offset): "사진 {photo}{photo:은|는} 카메라 {camera} 영상의 일부로, {offset} px에서 시작합니다.";
    weak_other_distance(photo, camera, value): "사진 {photo}의 주점거리는 {value}{value:으로|로}, 카메라 {camera}의 값과 다릅니다.";

    // Photos
    photo: "사진";
    file: "파일";
    orientation_convention: "각 ω, φ, κ는 대상 좌표차를 카메라 좌표계로 돌립니다: M = Mκ Mφ Mω. x는 오른쪽, y는 위, 카메라는 −z 방향을 봅니다.";
    projection_centres: "투영중심";
    angles: "회전각";

    // Points
    role: "구분";
    role_tie: "결합점";
    role_control: "기준점";
    role_check: "검사점";

    // Control, check, scale
    control_held(n, points): "주어진 좌표로 고정한 기준점 {n}점: {points}.";
    control_observed: "표준오차가 있는 기준점 좌표";
    control_coordinate: "기준점";
    projection_centre: "투영중심";
    distance: "거리";
    camera_parameter: "매개변수";
    adjusted_minus_given: "차이는 조정값 − 주어진 값입니다.";
    kind: "종류";
    difference: "차이";
    given: "주어진 값";
    adjusted: "조정값";
    took_no_part: "제외";
    check_points: "검사점";
    no_check_points: "검사점이 없습니다.";
    mean: "평균";
    rms: "RMS";
    check_rms_all(n, rms): "검사점 {n}점의 전 축 RMS는 {rms}입니다.";

    // Lengths
    lengths_explained: "조정에 쓰지 않은 교정 길이와 측정값의 비교: E = 측정값 − 교정값.";
    calibrated: "교정값";
    measured_length: "측정값";
    limit: "한계";
    within: "이내";
    beyond: "초과";
    largest_length_error(value, n): "길이 {n}개 중 가장 큰 길이 측정 오차의 크기는 {value}입니다.";
    limit_kept(formula): "모두 한계 {formula} 이내입니다.";
    limit_broken(formula, n): "길이 {n}개가 한계 {formula} 값을 넘습니다.";
    lengths_of_the_guideline: "VDI/VDE 2634 제1부를 따릅니다. 그 인수 검사는 측정 공간 안에 교정 길이 다섯 개씩인 측정선을 일곱 개 이상 요구하며, 그보다 적은 길이는 그만큼만 보여 줍니다.";

    // Statistics
    sigma0_long: "σ₀, 사후 단위중량 표준오차(사전 1)";
    global_test(percent): "전체 모형 검정(χ², 양측, {percent} %)";
    passed: "통과";
    failed: "실패";
    statistic_vpv: "통계량 vᵀPv";
    interval: "구간";
    critical_w(percent): "Baarda |w|의 임계값({percent} %)";
    critical_tau(percent): "Pope |τ|의 임계값({percent} %)";
    noncentrality(percent): "탐지 가능 오차의 δ₀(검정력 {percent} %)";
    mean_redundancy: "영상좌표의 평균 잉여수";
    low_redundancy(limit): "잉여수 {limit} 미만인 영상좌표";
    group: "관측값 종류";
    factor: "계수";
    unmodelled_px: "모형화되지 않은 부분 (px)";
    variance_components: "분산요소";
    estimated_from_residuals: "표준오차를 추정함";
    no_verdict: "표준오차를 추정하였으므로 판정 없음";
    times_a_priori_px(factor, px): "사전 표준오차 {px} px의 {factor}배";
    times_a_priori(factor): "사전 표준오차의 {factor}배";
    and_unmodelled(factor, px): "{factor}, 모형화되지 않은 오차 {px} px";
    not_estimated(group, redundancy, needed): "{group}: 추정하지 않았고 사전 표준오차를 그대로 썼습니다. 잉여도는 {redundancy}이며 분산을 추정하려면 {needed} 이상이어야 합니다.";
    no_residuals(group): "{group}: 잔차가 모두 0이어서 추정하지 않았고 사전 표준오차를 그대로 썼습니다.";
    iteration: "반복";
    step: "최대 변화";
    largest_w: "가장 큰 검정값";
    over: "초과";
    by_chance(over, limit, tests, expected): "관측값 {over}개가 {limit} 값을 넘습니다. 검정 {tests}회에서 우연히 넘을 기댓값은 {expected}회입니다.";

    // Residuals
    largest: "최대";
    mean_r: "평균 r";

    // Left out
    reason: "까닭";
    aside_disagrees: "다른 측정값과 맞지 않음";
    aside_photo: "사진을 표정하지 못함";
    aside_point: "점을 결정하지 못함";
    aside_undecided: "같은 수의 관측값이 다른 위치를 가리켜 어느 쪽이 맞는지 정할 수 없음";
    aside_by_hand: "문서에서 사용 안 함";
    round: "회";
    observation: "관측값";
    action: "조치";
    statistic: "통계량";
    removed: "제외";
    removed_with: "다른 것과 함께 제외";
    restored: "다시 포함";
    downweighted: "가중치 낮춤";
    kept: "발견했으나 유지";
    search_found_nothing: "과대오차 탐색에서 발견한 것이 없습니다.";
    no_search: "과대오차 탐색을 하지 않았습니다.";
    record_of_search: "과대오차 탐색 기록";

    // Features
    features: "형상";
    feature: "형상";
    feature_of: "대상";
    feature_line: "직선";
    feature_plane: "평면";
    feature_circle: "원";
    feature_sphere: "구";
    feature_cylinder: "원통";
    feature_distance: "거리";
    feature_angle: "각";
    feature_diameter: "지름";
    feature_deviations: "편차";
    feature_from(id): "{id} 기준";
    feature_from_given(n): "주어진 점 {n}개 기준";
    feature_points(n): "{n}점";
    feature_direction: "방향";
    feature_places: "위치와 방향";
    form_rms: "RMS";
    smallest_largest: "최소 … 최대";
    features_explained: "조정한 점에서 직교거리의 최소제곱으로 맞춘 형상이며 가중치는 쓰지 않습니다. 표준오차(1σ)는 점의 전체 공분산에서 구합니다. RMS, 최소, 최대는 점과 형상 사이의 거리입니다.";
    feature_weak(id, percent): "{id}: 표준오차가 없습니다. 점들이 반지름을 {percent} %까지만, 또는 방향을 그만큼의 1/100 라디안까지만 결정합니다(측정에 쓴 형상 포함).";
    feature_lacks(id, points): "{id}: 이 조정에 없는 점은 빠졌습니다({points}).";
    feature_failed(id, why): "{id}: 측정할 수 없습니다. {why}.";
    lacks_points(given, needed): "이 조정에서 결정된 점이 {given}개인데 {needed}개가 필요합니다";
    lacks_point(name): "점 {name}의 좌표가 이 조정에서 결정되지 않았습니다";
    points_undetermined: "점들이 한곳, 한 직선이나 한 평면 위에 있거나 그에 너무 가깝습니다";
    fit_unsettled: "점에 맞추는 계산이 수렴하지 않았습니다";
    not_fitted(name): "{name}{name:은|는} 점에 맞춘 형상이 아닙니다";
    built_on_broken(name): "{name} 형상을 측정할 수 없어 그에 따른 값도 없습니다";
    lacks_direction: "각은 두 방향 사이, 또는 한 점에서 다른 두 점 사이에서 잽니다";
    feature_not_measured(id): "{id}: 이 결과 뒤에 정의하여 아직 측정하지 않았습니다.";
    system_named(id): "좌표계 {id}";
    system_automatic: "대상물 평면 기준: Z는 사진 쪽을 향한 법선, X는 긴 방향, 원점은 무게중심.";
    system_plane_line_point: "평면, 직선, 점(3-2-1): 평면에서 Z = 0, 직선에서 Y = 0, 점에서 X = 0.";
    system_best_fit: "주어진 좌표에 최적 맞춤.";
    system_fit(sigma, redundancy, scale): "맞춤의 σ₀ {sigma}, 자유도 {redundancy}, 축척 {scale}.";

    // Plots
    plot_radial(camera): "방사왜곡, 카메라 {camera}";
    plot_radial_says(value, sigma, unit, r, radius_unit, widened): "가장 바깥 표적 r = {r} {radius_unit}에서 왜곡은 {value} ± {sigma} {unit}입니다(1σ). 띠의 폭은 {widened}σ이며, 가장 바깥 표적 밖의 곡선은 수식에만 근거합니다.";
    as_estimated: "추정한 대로";
    balanced: "균형형: 반지름의 2/3에서 0";
    no_target_beyond(r, unit): "{r} {unit} 밖 표적 없음";
    plot_decentring(camera): "편심왜곡, 카메라 {camera}";
    plot_decentring_says(value, sigma, unit, r, radius_unit): "가장 바깥 표적 r = {r} {radius_unit}에서 편심왜곡은 최대 {value} ± {sigma} {unit}입니다(1σ). 띠의 폭은 2σ입니다.";
    plot_significance(camera): "매개변수의 유의성, 카메라 {camera}";
    plot_significance_all(limit): "모든 왜곡 매개변수가 0과 구별됩니다. 모두 표준오차의 {limit}배를 넘습니다.";
    plot_significance_says(names, limit): "표준오차의 {limit}배 미만으로 0과 구별되지 않는 것: {names}. 고정하거나, 드러나도록 촬영하십시오.";
    log_ratio: "log₁₀ |값| / σ";
    plot_network_above: "위에서 본 관측망";
    plot_network_front: "앞에서 본 관측망";
    plot_network_says(photos, points, factor): "촬영점 {photos}곳과 {points}점. 선은 촬영점에서 그 사진이 보는 점들의 중심으로 갑니다. 오차타원 1σ, {factor}배.";
    plot_rays: "광선 수별 점";
    plot_rays_says(fewest, most, two): "점마다 광선이 {fewest}개에서 {most}개까지 만납니다. 셋 미만인 점: {two}. 이런 점은 에피폴라선 방향으로 점검되지 않습니다.";
    plot_angles: "최대 교회각별 점";
    plot_angles_says(median, least): "점의 절반은 {median}° 이상으로 만나는 광선이 있으며(예각으로 환산), 가장 좁은 것은 {least}°입니다. 5° 미만이면 깊이를 알 수 없습니다.";
    largest_angle: "최대 교회각, 도";
    plot_sigmas: "점의 표준오차";
    plot_sigmas_says(n, median, top, ratio): "최대 σ 순으로 늘어놓은 {n}점 중 가운데 점은 {median}, 마지막 점은 {top}이며 {ratio}배입니다.";
    points_by_size: "점, 최대 σ 순";
    plot_histogram: "표준화 잔차";
    plot_histogram_says(n, spread, beyond, limit): "검정값 w {n}개의 표준편차는 {spread}입니다(가정한 정확도가 옳으면 1). 선은 정규분포이며, ± {limit} 밖에 {beyond}개가 있습니다.";
    number_of: "개수";
    plot_normal: "표준화 잔차의 정규확률그림";
    plot_normal_says: "정규분포를 따르는 잔차는 직선 위에 놓이며, 가정한 정확도가 옳으면 점선 위입니다. 끝이 휘면 과대오차이거나 정규분포보다 꼬리가 두꺼운 것입니다.";
    normal_quantile: "정규 분위수";
    plot_convergence: "수렴";
    plot_convergence_says(n, sigma0): "반복 {n}회의 σ₀이며, {sigma0}에서 끝났습니다.";
    plot_deviations(id): "편차: {id}";
    plot_deviations_says(n, rms, low, high, unit): "점 {n}개: RMS {rms}, {low}에서 {high} {unit}까지. 양이면 위로 그렸습니다.";
    laid_plane: "평면을 법선 방향에서 본 것입니다.";
    laid_cylinder: "원통을 펼친 것입니다: 축 둘레의 각에 대한 축 방향 높이.";
    laid_sphere: "구를 펼친 것입니다: 경도에 대한 위도.";
    laid_circle: "원의 중심 둘레의 각에 따른 것입니다.";
    laid_line: "직선을 따른 것이며, 직선에서의 거리에는 부호가 없습니다.";
    plot_radius: "반지름에 따른 잔차";
    plot_radius_clean(worst, unit): "영상 반지름에 따른 잔차의 방사 성분과 구간 평균. 평균은 0에서 3σ 이내이며(최대 {worst} {unit}) 왜곡 모형이 남긴 것이 없습니다.";
    plot_radius_says(n, worst, unit): "영상 반지름에 따른 잔차의 방사 성분과 구간 평균. {n}개 구간의 평균이 0에서 3σ 밖에 있습니다(최대 {worst} {unit}). 왜곡 모형이 남긴 것이 있으니 왜곡 매개변수를 더 추정하십시오.";
    plot_all_residuals(camera): "한 화면에 모은 모든 사진의 잔차, 카메라 {camera}";
    plot_all_residuals_says(n, photos): "사진 {photos}매의 잔차 {n}개를 센서 위의 자리에 그렸습니다. 이웃이 같은 방향을 가리키면 잡음이 아니라 렌즈의 계통오차입니다.";
    plot_residuals(photo): "잔차, 사진 {photo}";
    plot_residuals_says(x, y, unit, n): "RMS x {x}, y {y} {unit}, {n}점";
    plot_redundancy(camera): "사진 위의 잉여수, 카메라 {camera}";
    plot_redundancy_says(mean, low, limit): "점이 클수록 다른 관측값으로 덜 점검됩니다. x, y 중 작은 r의 평균은 {mean}이며, {limit} 미만은 {low}개입니다.";

    plot_comparison: "이전 조정과의 비교";
    plot_comparison_says(n, rms, largest, point, limit, beyond, before, after): "두 조정에 공통인 {n}점은 평균(RMS) {rms} 움직였고, 가장 큰 것은 점 {point}의 {largest}입니다. 표준오차의 {limit}배를 넘는 것: {beyond}. σ₀: {before} → {after}.";
    points_by_shift: "점, 움직인 크기 순";

    // Settings
    options: "설정";
    software: "소프트웨어";
    termination: "반복의 끝";
    converged: "수렴";
    iteration_limit: "반복 한도";
    diverged: "발산";
    stopped: "중단";
    max_iterations: "최대 반복 수";
    a_priori_image: "영상좌표의 사전 σ";
    residuals_taken: "잔차";
    residuals_measured: "측정값에서";
    residuals_corrected: "보정한 위치에서";
    statistics_none: "없음";
    statistics_precision: "표준오차";
    statistics_full: "전체";
    snooping: "데이터 스누핑";
    robust: "강건 가중";
    target_diameter: "공통 표적 지름";
    estimated_parameters: "카메라 매개변수";
    free: "추정";
    observed: "관측";
    inputs: "입력 자료";
    inputs_explained: "이 입력 자료와 설정, 버전으로 같은 수치를 다시 계산할 수 있습니다. 문서의 해시값은 내보낸 JSON에서 “report” 부분을 뺀 것의 값이고, 사진의 해시값은 파일의 값입니다.";
    input: "입력";
    the_document: "문서";
    not_recorded: "기록 없음";
} }
