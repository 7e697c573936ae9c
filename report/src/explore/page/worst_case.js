// The worst case over all signs: the farthest point of a zonotope, and the length of an error with several parts.

/** @typedef {number[]} Vector */

/**
 * Returns the longest vector `center + Σ ± v` over all signs, as `abbe analyze` finds it: each vertex is on a face, whose
 * normal is perpendicular to two of the vectors and gives the signs of all others.
 * @param {Vector} center @param {Vector[]} all @returns {Vector}
 */
export function worstCase(center, all) {
    const vectors = all.filter((v) => v.some((row) => row !== 0));
    let [longest, square] = [center, -1];
    const put = (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ z) => {
        if (x * x + y * y + z * z > square) [longest, square] = [[x, y, z], x * x + y * y + z * z];
    };
    const [a, b, c] = center;
    if (vectors.length <= 3) {
        for (let signs = 0; signs < 1 << vectors.length; signs++) {
            const sum = (/** @type {number} */ i) => vectors.reduce((sum, v, k) => sum + (signs >> k & 1 ? -v[i] : v[i]), center[i]);
            put(sum(0), sum(1), sum(2));
        }
        return longest;
    }
    // Vectors in a common plane, or parallel ones, must differ.
    const distinct = vectors.map((v, k) => v.map((row, i) => row + 1e-9 * Math.hypot(...v) * Math.sin([1.3, 2.1, 3.7][i] * (k + 1))));
    vectors.forEach((v, i) => vectors.slice(i + 1).forEach((w, after) => {
        const j = i + 1 + after;
        const [[vx, vy, vz], [wx, wy, wz]] = [distinct[i], distinct[j]];
        const [nx, ny, nz] = [vy * wz - vz * wy, vz * wx - vx * wz, vx * wy - vy * wx];
        let [x, y, z] = [0, 0, 0];
        for (let k = 0; k < vectors.length; k++) {
            if (k === i || k === j) continue;
            const [normal, sum] = [distinct[k], vectors[k]];
            const sign = nx * normal[0] + ny * normal[1] + nz * normal[2] < 0 ? -1 : 1;
            x += sign * sum[0];
            y += sign * sum[1];
            z += sign * sum[2];
        }
        for (let signs = 0; signs < 8; signs++) {
            const [side, one, other] = [signs & 4 ? -1 : 1, signs & 2 ? -1 : 1, signs & 1 ? -1 : 1];
            put(a + (side * x + (one * v[0] + other * w[0])), b + (side * y + (one * v[1] + other * w[1])),
                c + (side * z + (one * v[2] + other * w[2])));
        }
    }));
    return longest;
}

/**
 * Returns the largest norm of an error with several parts, `B x` with `‖x‖ ≤ 1`: the root of the largest eigenvalue of `B Bᵀ`,
 * by Jacobi's rotations, each of which makes an entry beside the diagonal zero.
 * @param {Vector[]} parts @returns {number}
 */
export function largestNorm(parts) {
    const a = [0, 1, 2].map((i) => [0, 1, 2].map((j) => parts.reduce((sum, part) => sum + part[i] * part[j], 0)));
    for (let turn = 0; turn < 24; turn++) {
        const [i, j] = [[0, 1], [0, 2], [1, 2]][turn % 3];
        if (a[i][j] === 0) continue;
        const half = (a[j][j] - a[i][i]) / (2 * a[i][j]);
        const tangent = (half < 0 ? -1 : 1) / (Math.abs(half) + Math.hypot(half, 1));
        const [cosine, k] = [1 / Math.hypot(tangent, 1), 3 - i - j];
        const [first, second] = [a[k][i], a[k][j]];
        a[i][i] -= tangent * a[i][j];
        a[j][j] += tangent * a[i][j];
        a[k][i] = a[i][k] = cosine * (first - tangent * second);
        a[k][j] = a[j][k] = cosine * (tangent * first + second);
        a[i][j] = a[j][i] = 0;
    }
    return Math.sqrt(Math.max(0, a[0][0], a[1][1], a[2][2]));
}
