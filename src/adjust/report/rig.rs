//! Relative poses of the rig in the result.

use nalgebra::Matrix3;

use super::result::{Solved, root};
use crate::adjust::problem::rig::Member;
use crate::adjust::solve::session::RigStatistics;
use crate::adjustment::{RelativeDeviation, RelativePose};
use crate::rotation;
use crate::statistics::distribution::ALPHA;

impl Solved<'_> {
    /// Every camera of the rig that has an exposure with the first one.
    pub fn relative_poses(&self) -> Vec<RelativePose> {
        let members = self.network.rig.iter().enumerate();
        let mut poses: Vec<RelativePose> =
            members.map(|(k, member)| self.relative_pose(member, self.rig.get(k))).collect();
        // The most significant one of all is named: it moves the means and the first camera, from which others are off then too.
        let all = poses.iter_mut().flat_map(|pose| &mut pose.exposures);
        let tested = all.filter_map(|off| Some((off.p_value?, off.statistic?, off)));
        let most = tested.min_by(|a, b| a.0.total_cmp(&b.0).then(b.1.total_cmp(&a.1)));
        if let Some((p_value, _, off)) = most {
            off.outlier = p_value < ALPHA;
        }
        poses
    }

    fn relative_pose(&self, member: &Member, statistics: Option<&RigStatistics>) -> RelativePose {
        let covariance = statistics.map(|statistics| &statistics.covariance);
        let test = |k: usize| statistics.and_then(|statistics| statistics.tests.get(k).copied().flatten());
        let scale = self.frame().scale;
        let mean = member.mean(self.state);
        let position = mean.position * scale;
        let base = position.norm();
        let photo = |k: usize| &self.project.photos[self.network.photos[k].index];
        let (mut camera, mut relative_to) = (String::new(), String::new());
        let mut exposures = Vec::with_capacity(member.exposures.len());
        let mut squares = [0.0; 2];
        for (k, ((exposure, photos), off)) in member.exposures.iter().zip(&mean.deviations).enumerate() {
            let [first, own] = photos.map(photo);
            (camera, relative_to) = (own.camera.clone(), first.camera.clone());
            let deviation = RelativeDeviation {
                exposure: *exposure,
                photos: [first.id.clone(), own.id.clone()],
                position: std::array::from_fn(|a| off[3 + a] * scale),
                rotation: std::array::from_fn(|a| off[a]),
                redundancy: test(k).map(|test| test.redundancy),
                degrees: test(k).map(|test| test.degrees),
                statistic: test(k).map(|test| test.statistic),
                p_value: test(k).map(|test| test.p_value),
                outlier: false,
            };
            squares[0] += deviation.rotation.iter().map(|x| x * x).sum::<f64>();
            squares[1] += deviation.position.iter().map(|x| x * x).sum::<f64>();
            exposures.push(deviation);
        }
        let freedom = 3 * (exposures.len() - 1);
        let scatter = |squares: f64| (freedom > 0).then(|| (squares / freedom as f64).sqrt());
        let sigmas = |first: usize| covariance.map(|c| std::array::from_fn(|a| root(c[(first + a, first + a)])));
        let sigma_base = covariance.filter(|_| base > 0.0).map(|c| {
            let own: Matrix3<f64> = c.fixed_view::<3, 3>(3, 3).into();
            root((position.transpose() * own * position)[0]) / base
        });
        RelativePose {
            column: member.column,
            camera,
            relative_to,
            position: position.into(),
            sigma_position: sigmas(3),
            rotation: rotation::angles(&mean.rotation),
            sigma_rotation: sigmas(0),
            base,
            sigma_base,
            exposures,
            scatter_position: scatter(squares[1]),
            scatter_rotation: scatter(squares[0]),
        }
    }
}
