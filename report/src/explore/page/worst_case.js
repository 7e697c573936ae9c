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
 * Returns the largest norm of an error with several parts, `B x` with `‖x‖ ≤ 1`: the root of the largest eigenvalue of `B Bᵀ`.
 * @param {Vector[]} parts @returns {number}
 */
export function longest(parts) {
    const [xx, yy, zz, xy, xz, yz] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]].map(([i, j]) =>
        parts.reduce((sum, part) => sum + part[i] * part[j], 0));
    const mean = (xx + yy + zz) / 3;
    const [a, b, c] = [xx - mean, yy - mean, zz - mean];
    const spread = Math.sqrt((a * a + b * b + c * c + 2 * (xy * xy + xz * xz + yz * yz)) / 6);
    const determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
    const angle = Math.acos(Math.min(1, Math.max(-1, determinant / (2 * spread ** 3) || 0))) / 3;
    return Math.sqrt(Math.max(0, mean + 2 * spread * Math.cos(angle)));
}
