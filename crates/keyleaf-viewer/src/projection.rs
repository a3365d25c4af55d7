//! Between the world and the place in the window where the scene is shown.

use egui::{Pos2, Rect, pos2};
use glam::DVec3;
use keyleaf::{Projection, View};

/// A view, and the rectangle of the window that it fills, in points.
#[derive(Debug, Clone, Copy)]
pub struct Screen {
    /// The view.
    pub view: View,
    /// The rectangle.
    pub rect: Rect,
}

impl Screen {
    /// World to view space: right, up, backwards.
    fn seen(&self, point: DVec3) -> DVec3 {
        self.view.orientation.inverse() * (point - self.view.eye)
    }

    /// Half the height of what is seen at distance 1 (perspective) or anywhere (orthographic), and the near plane.
    fn half_height(&self) -> (f64, f64) {
        match self.view.projection {
            Projection::Perspective { fov_y, near } => ((fov_y / 2.0).tan(), near),
            Projection::Orthographic { height, near, .. } => (height / 2.0, near),
        }
    }

    fn place(&self, seen: DVec3) -> Pos2 {
        let (half, _) = self.half_height();
        let depth = match self.view.projection {
            Projection::Perspective { .. } => -seen.z,
            Projection::Orthographic { .. } => 1.0,
        };
        let scale = f64::from(self.rect.height()) / 2.0 / (half * depth);
        let centre = self.rect.center();
        // Far outside, painters lose digits.
        let clamp = |x: f64| x.clamp(-1e5, 1e5) as f32;
        pos2(centre.x + clamp(seen.x * scale), centre.y - clamp(seen.y * scale))
    }

    /// The height of what an orthographic view sees, in metres; of a perspective one, at distance 1.
    pub fn view_height(&self) -> f64 {
        2.0 * self.half_height().0
    }

    /// Where a point is seen; `None` before the near plane.
    pub fn point(&self, point: DVec3) -> Option<Pos2> {
        let seen = self.seen(point);
        let (_, near) = self.half_height();
        (-seen.z >= near).then(|| self.place(seen))
    }

    /// Where a line is seen, as far as it lies behind the near plane.
    pub fn segment(&self, from: DVec3, to: DVec3) -> Option<[Pos2; 2]> {
        let (_, near) = self.half_height();
        let (mut a, mut b) = (self.seen(from), self.seen(to));
        let limit = -near * 1.001 - 1e-12;
        if a.z > limit && b.z > limit {
            return None;
        }
        let cut = |inside: DVec3, outside: DVec3| inside.lerp(outside, (limit - inside.z) / (outside.z - inside.z));
        if a.z > limit {
            a = cut(b, a);
        } else if b.z > limit {
            b = cut(a, b);
        }
        Some([self.place(a), self.place(b)])
    }

    /// The ray through a place of the window: origin and unit direction.
    pub fn ray(&self, at: Pos2) -> (DVec3, DVec3) {
        let (half, _) = self.half_height();
        let scale = 2.0 * half / f64::from(self.rect.height().max(1.0));
        let x = f64::from(at.x - self.rect.center().x) * scale;
        let y = -f64::from(at.y - self.rect.center().y) * scale;
        match self.view.projection {
            Projection::Perspective { .. } => {
                let direction = self.view.orientation * DVec3::new(x, y, -1.0).normalize();
                (self.view.eye, direction)
            }
            Projection::Orthographic { .. } => {
                let origin = self.view.eye + self.view.orientation * DVec3::new(x, y, 0.0);
                (origin, self.view.orientation * DVec3::NEG_Z)
            }
        }
    }

    /// The corners of what the view sees at a distance along its axis, from the lower left, counter-clockwise.
    pub fn corners(view: &View, distance: f64) -> [DVec3; 4] {
        let half = match view.projection {
            Projection::Perspective { fov_y, .. } => (fov_y / 2.0).tan() * distance,
            Projection::Orthographic { height, .. } => height / 2.0,
        };
        let wide = half * view.aspect();
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| view.eye + view.orientation * DVec3::new(x * wide, y * half, -distance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::vec2;
    use glam::UVec2;

    fn screen() -> Screen {
        Screen {
            view: View::look_at(DVec3::new(3.0, 2.0, 5.0), DVec3::ZERO, 1.0, 0.1, UVec2::new(640, 480)),
            rect: Rect::from_min_size(pos2(10.0, 20.0), vec2(640.0, 480.0)),
        }
    }

    #[test]
    fn the_ray_through_a_point_meets_it() {
        let screen = screen();
        let point = DVec3::new(0.4, -0.2, 1.0);
        let (origin, direction) = screen.ray(screen.point(point).unwrap());
        let along = (point - origin).dot(direction);
        assert!((origin + direction * along).distance(point) < 1e-5);
    }

    #[test]
    fn lines_are_cut_at_the_near_plane() {
        let screen = screen();
        let behind = screen.view.eye * 2.0;
        assert!(screen.point(behind).is_none());
        let [_, end] = screen.segment(DVec3::ZERO, behind).unwrap();
        assert!(end.x.is_finite() && end.y.is_finite());
        assert!(screen.segment(behind, behind * 2.0).is_none());
    }

    #[test]
    fn corners_fill_the_rectangle() {
        let screen = screen();
        let seen = Screen::corners(&screen.view, 3.0).map(|c| screen.point(c).unwrap());
        assert!(seen[0].distance(screen.rect.left_bottom()) < 0.1);
        assert!(seen[2].distance(screen.rect.right_top()) < 0.1);
    }
}
