#![allow(missing_docs, clippy::unwrap_used)]
use rock_field::params::wood_ear::*;
use rock_field::wood_ear::*;
use std::time::Instant;
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let mut p = preset(&args[0]).unwrap().params();
    for kv in &args[1..] {
        if kv.ends_with(".obj") {
            continue;
        }
        let (k, v) = kv.split_once('=').unwrap();
        let spec = PARAMS.iter().find(|s| s.key == k).unwrap();
        if let Scope::Field(_, set) = spec.scope {
            set(&mut p, v.parse().unwrap());
        }
    }
    let mut g = Generator::new();
    let t = Instant::now();
    g.start(p.clone(), u64::MAX).unwrap();
    let mut worst = [0.0_f64; 6];
    let mut total = [0.0_f64; 6];
    let mut preview = None;
    loop {
        let s = g.stage() as usize;
        let u = Instant::now();
        let done = g.step();
        let ms = u.elapsed().as_secs_f64() * 1e3;
        worst[s] = worst[s].max(ms);
        total[s] += ms;
        if preview.is_none() && g.preview_ready() {
            preview = Some(t.elapsed().as_secs_f64() * 1e3);
        }
        if done {
            break;
        }
    }
    println!(
        "log {} fine {} total {:.1} ms preview {:.1}",
        g.log().points.len(),
        g.log_mesh().positions.len() / 3,
        t.elapsed().as_secs_f64() * 1e3,
        preview.unwrap()
    );
    println!("stages {total:.1?} worst {worst:.1?}");
    println!("{:?}", g.stats());
    if let Some(f) = args.iter().find(|a| a.ends_with(".obj")) {
        use std::fmt::Write;
        let mut o = String::new();
        let mut off = 1;
        for (pos, idx, name) in
            [(&g.log_mesh().positions, &g.log_mesh().indices, "log"), (&g.mesh().positions, &g.mesh().indices, "ears")]
        {
            writeln!(o, "o {name}").unwrap();
            for v in pos.chunks(3) {
                writeln!(o, "v {} {} {}", v[0], v[1], v[2]).unwrap();
            }
            for t in idx.chunks(3) {
                writeln!(o, "f {} {} {}", t[0] + off, t[1] + off, t[2] + off).unwrap();
            }
            off += pos.len() as u32 / 3;
        }
        std::fs::write(f, o).unwrap();
    }
}
