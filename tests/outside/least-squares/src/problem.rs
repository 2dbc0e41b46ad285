//! Two of the NIST/ITL reference problems for nonlinear regression, with their certified values.

/// Reference problem.
pub struct Reference {
    /// Points `[y, x]`.
    pub points: &'static [[f64; 2]],
    /// Value of the model with the parameters at `x`.
    pub model: fn(&[f64], f64) -> f64,
    /// Writes the derivatives of the model by the parameters at `x`.
    pub gradient: fn(&[f64], f64, &mut [f64]),
    /// One of the two starts that come with the problem.
    pub start: &'static [f64],
    /// Certified value of each parameter, and its standard error.
    pub certified: &'static [[f64; 2]],
}

/// `y = b1 (1 − exp(−b2 x))`, from the start that is far from the solution.
pub const MISRA1A: Reference = Reference {
    points: &[
        [10.07, 77.6],
        [14.73, 114.9],
        [17.94, 141.1],
        [23.93, 190.8],
        [29.61, 239.9],
        [35.18, 289.0],
        [40.02, 332.8],
        [44.82, 378.4],
        [50.76, 434.8],
        [55.05, 477.3],
        [61.01, 536.8],
        [66.40, 593.1],
        [75.47, 689.1],
        [81.78, 760.0],
    ],
    model: |b, x| b[0] * (1.0 - (-b[1] * x).exp()),
    gradient: |b, x, out| {
        let decay = (-b[1] * x).exp();
        out.copy_from_slice(&[1.0 - decay, b[0] * x * decay]);
    },
    start: &[500.0, 1e-4],
    certified: &[[2.389_421_291_8e2, 2.707_007_524_1], [5.501_564_318_1e-4, 7.266_868_843_6e-6]],
};

/// `y = b1 + b2 exp(−b4 x) + b3 exp(−b5 x)`.
pub const MGH17: Reference = Reference {
    points: &[
        [0.844, 0.0],
        [0.908, 10.0],
        [0.932, 20.0],
        [0.936, 30.0],
        [0.925, 40.0],
        [0.908, 50.0],
        [0.881, 60.0],
        [0.850, 70.0],
        [0.818, 80.0],
        [0.784, 90.0],
        [0.751, 100.0],
        [0.718, 110.0],
        [0.685, 120.0],
        [0.658, 130.0],
        [0.628, 140.0],
        [0.603, 150.0],
        [0.580, 160.0],
        [0.558, 170.0],
        [0.538, 180.0],
        [0.522, 190.0],
        [0.506, 200.0],
        [0.490, 210.0],
        [0.478, 220.0],
        [0.467, 230.0],
        [0.457, 240.0],
        [0.448, 250.0],
        [0.438, 260.0],
        [0.431, 270.0],
        [0.424, 280.0],
        [0.420, 290.0],
        [0.414, 300.0],
        [0.411, 310.0],
        [0.406, 320.0],
    ],
    model: |b, x| b[0] + b[1] * (-b[3] * x).exp() + b[2] * (-b[4] * x).exp(),
    gradient: |b, x, out| {
        let [slow, fast] = [(-b[3] * x).exp(), (-b[4] * x).exp()];
        out.copy_from_slice(&[1.0, slow, fast, -b[1] * x * slow, -b[2] * x * fast]);
    },
    start: &[0.5, 1.5, -1.0, 0.01, 0.02],
    certified: &[
        [3.754_100_521_1e-1, 2.072_315_355_1e-3],
        [1.935_846_912_7, 2.203_166_922_2e-1],
        [-1.464_687_136_6, 2.217_570_773_9e-1],
        [1.286_753_464_0e-2, 4.486_135_811_4e-4],
        [2.212_269_966_2e-2, 8.947_199_657_5e-4],
    ],
};
