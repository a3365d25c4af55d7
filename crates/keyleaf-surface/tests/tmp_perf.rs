//! x
mod device;
mod fixtures;
mod shaders;
use fixtures::*;
fn cpu() -> f64 {
    let s = std::fs::read_to_string("/proc/self/stat").unwrap();
    let f: Vec<&str> = s.rsplit(')').next().unwrap().split_whitespace().collect();
    (f[11].parse::<f64>().unwrap() + f[12].parse::<f64>().unwrap()) / 100.0
}
#[test]
fn perf() {
    let d = device::Device::new().unwrap();
    for f in fixtures() {
        let t = f.surface.tables(f.origin);
        let src = shaders::composed(f.surface.shader());
        let words = f.surface.topology().gpu_words();
        let mut r = Random(1);
        // vertices of leaves of a uniform level 6..12: neighbours in memory as when drawing
        let mut pts = vec![];
        while pts.len() < 500_000 {
            let (face, root) = r.root(f.surface.topology());
            let leaf = (0..6).fold(keyleaf_key::Place::of_root(face, root), |p, _| p.child(r.below(4)));
            let s = leaf.unit() / 8;
            for a in 0..=8u32 {
                for b in 0..=8 - a {
                    pts.push(leaf.at(a * s, b * s));
                }
            }
        }
        let leaves: Vec<_> = (0..200_000).map(|_| r.leaf(f.surface.topology())).collect();
        let time = |src: &str, p: &[_], l: &[_]| {
            let c = cpu();
            device::evaluate(&d, src, &t, &words, p, l);
            cpu() - c
        };
        let null = "fn surface_null(face: u32, at: FaceCoord) -> vec3f { return vec3f(f32(at.x)); }\n";
        let base = time(&(src.clone() + null + "//NULL"), &pts, &[]);
        let point = time(&(src.clone() + "//POINT"), &pts, &[]);
        let both = time(&src, &pts, &[]);
        let lb = time(&src, &[], &leaves);
        println!(
            "{:36} base {:.3} point {:.3} us, point+frame {:.3} us, bound {:.3} us",
            f.name,
            base / pts.len() as f64 * 1e6,
            (point - base) / pts.len() as f64 * 1e6,
            (both - base) / pts.len() as f64 * 1e6,
            lb / leaves.len() as f64 * 1e6
        );
    }
    for n in [1201u32, 4097] {
        let h = hills(n, n);
        let c = cpu();
        let s = keyleaf_surface::HeightField::new(h, Default::default()).unwrap();
        println!("bounds {n}: {:.2} s", cpu() - c);
        drop(s);
    }
}
