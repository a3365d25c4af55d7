//! Runs of the executable model in Python, recorded: leaf sets of every pass under the metrics of [`crate::metrics`], which are
//! the same bits there and here. The model's nodes were hashed as [`hash`] does; its metrics were rounded by
//! `forest::wish`; its level limit was 4.

use crate::meshes;
use crate::metrics::{Kind, Metric, hash, mix};
use crate::model_pressure::ModelPressure;
use keyleaf_key::Forest;

/// What the model did under one metric, after those before it.
struct Jump {
    /// The last pass that changed the number of leaves, counted from 1.
    last_change: usize,
    /// Number of leaves after the last pass.
    leaves: usize,
    /// Steps of pressure after the last pass.
    steps: u32,
    /// Digest of the leaf sets, and in a starved run of the pressure, after every pass so far.
    digest: u64,
}

struct Run {
    kind: Kind,
    seed: u64,
    /// Free runs have 25 passes a jump; starved ones 60, and pressure.
    capacity: Option<usize>,
    jumps: &'static [Jump],
}

const fn jump(last_change: usize, leaves: usize, steps: u32, digest: u64) -> Jump {
    Jump {
        last_change,
        leaves,
        steps,
        digest,
    }
}

const fn free(kind: Kind, seed: u64, jumps: &'static [Jump]) -> Run {
    Run {
        kind,
        seed,
        capacity: None,
        jumps,
    }
}

const fn starved(kind: Kind, seed: u64, capacity: usize, jumps: &'static [Jump]) -> Run {
    Run {
        kind,
        seed,
        capacity: Some(capacity),
        jumps,
    }
}

fn replay(mesh: &meshes::Mesh, run: &Run) {
    let topology = mesh.topology();
    let (mut forest, mut pressure, mut digest) = (Forest::new(&topology, 4), ModelPressure::default(), 0);
    let (passes, first_metric) = if run.capacity.is_some() { (60, 77) } else { (25, 0) };
    for (number, jump) in (0..).zip(run.jumps) {
        let metric = Metric::new(run.kind, 1000 * run.seed + first_metric + number).on(&topology);
        let mut counts = Vec::new();
        for _ in 0..passes {
            let (scale, capacity) = (pressure.scale(), run.capacity.unwrap_or(usize::MAX));
            let changes = forest.update(|node| metric(node) * scale, capacity);
            if run.capacity.is_some() {
                pressure.observe(&forest, changes.leaves_changed(), capacity);
            }
            let set = forest
                .leaves
                .keys()
                .map(|leaf| hash(leaf.key(), 0))
                .fold(0, u64::wrapping_add);
            digest = mix(digest ^ set ^ u64::from(pressure.steps));
            counts.push(forest.leaves.len());
        }
        let last = counts[passes - 1];
        let last_change = counts
            .iter()
            .rposition(|count| *count != last)
            .map_or(1, |pass| pass + 2);
        let found = (last_change, last, pressure.steps, digest);
        let recorded = (jump.last_change, jump.leaves, jump.steps, jump.digest);
        assert_eq!(
            found, recorded,
            "{:?} seed {} jump {number} capacity {:?}",
            run.kind, run.seed, run.capacity
        );
    }
}

#[test]
fn every_pass_on_the_cube_has_the_leaves_that_the_model_had() {
    CUBE.iter().for_each(|run| replay(&meshes::cube(), run));
}

#[test]
fn every_pass_on_the_tetrahedron_has_the_leaves_that_the_model_had() {
    TETRAHEDRON.iter().for_each(|run| replay(&meshes::tetrahedron(), run));
}

use Kind::{Distance, Graded, Random};

#[rustfmt::skip]
const CUBE: &[Run] = &[
    free(Random, 0, &[
        jump(13, 858, 0, 0x095b_e725_e349_f7c8),
        jump(10, 582, 0, 0x376c_9c92_6668_e070),
        jump(9, 1830, 0, 0x36c8_14f4_cff0_fe85),
    ]),
    free(Random, 1, &[
        jump(17, 612, 0, 0x176a_bb21_e54b_301a),
        jump(9, 282, 0, 0x3e1a_b0f3_b99c_8798),
        jump(9, 2724, 0, 0x793d_8878_0292_c05c),
    ]),
    free(Random, 2, &[
        jump(13, 870, 0, 0x85c4_288b_552e_415a),
        jump(9, 174, 0, 0x33ce_561c_56d4_f831),
        jump(11, 2112, 0, 0x87ce_7dbc_f714_b16b),
    ]),
    starved(Random, 0, 150, &[
        jump(59, 126, 3, 0x3a2b_f0e4_44e5_ddfb),
        jump(56, 72, 4, 0x5dc0_87d3_2aa7_0cbc),
    ]),
    starved(Random, 1, 300, &[
        jump(60, 54, 4, 0x91b8_40a9_8ea2_371c),
        jump(59, 162, 3, 0xbcec_678d_8056_fc76),
    ]),
    starved(Random, 2, 150, &[
        jump(57, 24, 3, 0x17f2_1262_ed2c_cf98),
        jump(57, 24, 3, 0xf91b_76e6_cc35_de7b),
    ]),
    free(Graded, 0, &[
        jump(13, 1554, 0, 0xe91b_8982_88d7_cadf),
        jump(10, 2316, 0, 0x10a0_7d17_8fbd_cf34),
        jump(5, 1986, 0, 0xa597_173e_be67_39bb),
    ]),
    free(Graded, 1, &[
        jump(13, 2880, 0, 0xa895_21ce_a817_b4c8),
        jump(6, 2844, 0, 0x8973_71b4_35c9_fd86),
        jump(6, 3312, 0, 0xb6e9_efd2_c17d_15d6),
    ]),
    free(Graded, 2, &[
        jump(13, 2184, 0, 0x0537_6fa9_f3ee_79bd),
        jump(6, 2304, 0, 0xe1af_4285_ae2a_5de7),
        jump(6, 2562, 0, 0xdf80_0aec_5c8a_1e31),
    ]),
    starved(Graded, 0, 150, &[
        jump(50, 132, 14, 0xadfc_628f_313d_ce61),
        jump(40, 150, 20, 0x0ea1_9ce6_c757_986a),
    ]),
    starved(Graded, 1, 300, &[
        jump(56, 282, 10, 0xe9eb_8b17_fb46_d808),
        jump(58, 258, 15, 0x5870_34e4_5c01_5871),
    ]),
    starved(Graded, 2, 150, &[
        jump(56, 102, 13, 0x15a9_cc0b_ccc0_18af),
        jump(57, 126, 18, 0x7137_2bc1_c543_1901),
    ]),
    free(Distance, 0, &[
        jump(5, 6006, 0, 0x4911_7518_9b91_d7df),
        jump(4, 1746, 0, 0x258b_5505_f4f7_c051),
        jump(6, 864, 0, 0xf979_536e_4366_4074),
    ]),
    free(Distance, 1, &[
        jump(5, 5928, 0, 0x1246_b61f_9988_ffb8),
        jump(4, 2334, 0, 0xfaf2_c09e_ff49_3566),
        jump(4, 1092, 0, 0xcb6a_2510_95de_42cf),
    ]),
    free(Distance, 2, &[
        jump(5, 5628, 0, 0x4950_0f87_4f3d_dded),
        jump(4, 2010, 0, 0xd6ca_0077_831c_83d4),
        jump(4, 1116, 0, 0x2b46_a575_5fec_04d1),
    ]),
    starved(Distance, 0, 150, &[
        jump(48, 138, 10, 0x7c28_983b_32c3_a54e),
        jump(60, 132, 9, 0xf54e_52d4_d4bb_86ea),
    ]),
    starved(Distance, 1, 300, &[
        jump(4, 264, 4, 0xbf45_df00_13cc_3b21),
        jump(16, 228, 3, 0xbbbc_68b4_ff99_f3fa),
    ]),
    starved(Distance, 2, 150, &[
        jump(32, 108, 8, 0x0fae_1d15_254a_0ee7),
        jump(27, 108, 5, 0xd50d_e7fb_c1fd_d68f),
    ]),
];

#[rustfmt::skip]
const TETRAHEDRON: &[Run] = &[
    free(Random, 0, &[
        jump(13, 414, 0, 0xaa24_abaa_8fa6_ac1f),
        jump(8, 132, 0, 0xdd23_cbba_0aef_9d10),
        jump(9, 1200, 0, 0xe380_a1e1_e949_577b),
    ]),
    free(Random, 1, &[
        jump(13, 546, 0, 0x213f_7640_05b0_b2b5),
        jump(9, 198, 0, 0x9cf6_26de_c6f6_f96b),
        jump(8, 1416, 0, 0xda6e_7b7f_c868_cb68),
    ]),
    free(Random, 2, &[
        jump(13, 492, 0, 0xea33_f9e7_6a23_937d),
        jump(9, 234, 0, 0x2bef_1cca_72f7_aff2),
        jump(8, 756, 0, 0x9f20_06bd_0c5c_bacb),
    ]),
    starved(Random, 0, 150, &[
        jump(5, 36, 0, 0x7c39_42b1_9abb_81b0),
        jump(56, 96, 4, 0xac0e_c9b3_d136_1b64),
    ]),
    starved(Random, 1, 300, &[
        jump(15, 234, 0, 0xb003_357f_d97b_7df7),
        jump(59, 48, 4, 0xc085_47a7_f36e_9fed),
    ]),
    starved(Random, 2, 150, &[
        jump(59, 90, 3, 0xe752_ad6a_d933_840d),
        jump(58, 90, 3, 0x1197_4406_5feb_496f),
    ]),
    free(Graded, 0, &[
        jump(15, 546, 0, 0x8d40_b8c4_dc61_c83a),
        jump(10, 594, 0, 0x90b4_6854_7fd8_d4ac),
        jump(7, 264, 0, 0xa7f3_ba73_2ddb_acd8),
    ]),
    free(Graded, 1, &[
        jump(11, 1062, 0, 0x77c1_0032_3b24_d305),
        jump(7, 1380, 0, 0x6985_abd1_082f_5080),
        jump(6, 1302, 0, 0x220d_8a90_29ed_5552),
    ]),
    free(Graded, 2, &[
        jump(11, 1260, 0, 0xbc8c_041e_0137_8095),
        jump(6, 1284, 0, 0xdf59_3d41_90b7_b1aa),
        jump(5, 1470, 0, 0x32fc_2b0c_cb5e_2742),
    ]),
    starved(Graded, 0, 150, &[
        jump(52, 144, 13, 0x9659_4b69_c840_fbfa),
        jump(55, 132, 14, 0xd26d_19c0_26e9_4579),
    ]),
    starved(Graded, 1, 300, &[
        jump(60, 72, 7, 0x7898_150c_93e4_720a),
        jump(12, 264, 7, 0x4206_eddd_b2c6_253d),
    ]),
    starved(Graded, 2, 150, &[
        jump(57, 132, 13, 0x2626_e32c_83e0_485e),
        jump(15, 138, 12, 0x4dbf_de1a_6d06_a7ca),
    ]),
];
