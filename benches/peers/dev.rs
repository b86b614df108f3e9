#[path = "many_spheres/scenes.rs"]
mod scenes;
use eyeray::{SphereBvh, Hittable, Spheres};
use std::hint::black_box;
use std::time::Instant;
fn main() {
    let mut args = std::env::args().skip(1).filter(|a| a != "--bench");
    let only = args.next().unwrap_or_default();
    let passes: usize = args.next().map_or(30, |a| a.parse().unwrap());
    let seed: u64 = args.next().map_or(1, |a| a.parse().unwrap());
    for scene in scenes::SCENES.iter().filter(|s| s.name.contains(&only)) {
        let s = (scene.spheres)(seed);
        let bvh: SphereBvh = s.iter().copied().collect();
        let scan: Spheres = s.iter().copied().collect();
        let mut rays = scenes::rays(&s, &bvh, 20000, seed); if std::env::var("FEW").is_ok() { for i in 64..rays.len() { rays[i] = rays[i % 64]; } }
        let mut least = [f64::MAX; 6];
        for _ in 0..passes {
            for half in 0..2 {
            let mut t = |slot: usize, f: &dyn Fn()| { let st = Instant::now(); f(); least[slot*2+half] = least[slot*2+half].min(st.elapsed().as_secs_f64() * 1e9 / rays.len() as f64 * 2.0); };
            t(0, &|| for r in rays.iter().skip(half).step_by(2) { black_box(bvh.nearest(black_box(r), 0.0..f32::INFINITY)); });
            t(1, &|| for r in rays.iter().skip(half).step_by(2) { black_box(bvh.occludes(black_box(r), 0.0..f32::INFINITY)); });
            if s.len() <= 1000 { t(2, &|| for r in rays.iter().skip(half).step_by(2) { black_box(scan.nearest(black_box(r), 0.0..f32::INFINITY)); }); }
            }
        }
        println!("{:<24} nearest {:>8.1} {:>8.1} occludes {:>8.1} {:>8.1} scan {:>8.1} {:>8.1}", scene.name, least[0], least[1], least[2], least[3], least[4].min(1e5), least[5].min(1e5));
    }
}
