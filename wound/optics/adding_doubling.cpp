#include "wound/optics/adding_doubling.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "wound/optics/fresnel.hpp"

namespace optics {

namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A direction is given by s = n sin(theta), which refraction does not change, so all layers use one set of
// nodes and a boundary never mixes nodes. All vectors hold the flux of a node. Node 0 is the normal
// direction; its weight is almost 0.
struct Nodes
{
    ArrayXd s2;     // s squared
    ArrayXd weight; // of s ds: the flux of isotropic light of unit radiance / n^2
};

// Abscissae and weights of Gauss-Legendre quadrature on [0, 1] (Newton's method on P_n).
void gauss_legendre(int count, ArrayXd& x, ArrayXd& w)
{
    x.resize(count);
    w.resize(count);
    for (int i = 0; i < count; ++i) {
        double z = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 1;
        for (int step = 0; step < 100; ++step) {
            double p = 1, before = 0;
            for (int k = 0; k < count; ++k)
                before = std::exchange(p, ((2 * k + 1) * z * p - k * before) / (k + 1));
            slope = count * (z * p - before) / (z * z - 1);
            const double move = p / slope;
            z -= move;
            if (std::abs(move) < 1e-15)
                break;
        }
        x[i] = 0.5 * (1 - z);
        w[i] = 1 / ((1 - z * z) * slope * slope);
    }
}

// A panel reaches from one medium's critical s to the next.
Nodes make_nodes(const Stack& stack, int angles, Quadrature quadrature)
{
    std::vector<double> indices{stack.n_above, stack.n_below};
    for (const LayerOptics& layer : stack.layers)
        indices.push_back(layer.n);
    std::sort(indices.begin(), indices.end());
    std::vector<double> ends;
    for (double n : indices)
        if (ends.empty() || n - ends.back() > 1e-6)
            ends.push_back(n);

    ArrayXd x, w;
    gauss_legendre(angles, x, w);
    const auto count = static_cast<Eigen::Index>(ends.size()) * angles + 1;
    Nodes nodes{ArrayXd::Zero(count), ArrayXd::Constant(count, 1e-10)};
    double start = 0;
    for (std::size_t p = 0; p < ends.size(); ++p) {
        // The variable is the cosine in a medium of index n, from its value at the panel's end to that at the
        // start.
        const double n = quadrature == Quadrature::Smooth ? ends[p] : ends.back();
        const double low = std::sqrt(1 - ends[p] * ends[p] / (n * n));
        const double high = std::sqrt(1 - start * start / (n * n));
        const ArrayXd cosine = low + (high - low) * x;
        const auto first = static_cast<Eigen::Index>(p) * angles + 1;
        nodes.s2.segment(first, angles) = n * n * (1 - cosine.square());
        nodes.weight.segment(first, angles) = n * n * (high - low) * cosine * w;
        start = ends[p];
    }
    return nodes;
}

// Reflection and transmission of one element, matrices of fluxes: out = M in.
struct Operator
{
    MatrixXd r_top, r_bottom, t_down, t_up;
};

Operator boundary(const Nodes& nodes, double n_above, double n_below)
{
    const Eigen::Index count = nodes.s2.size();
    const double thinner = std::min(n_above, n_below);
    // Total reflection is slightly below 1: with 1 the round-trip matrix of a clear layer would be singular.
    VectorXd r = VectorXd::Constant(count, 1 - 1e-15), t = VectorXd::Zero(count);
    for (Eigen::Index j = 0; j < count; ++j)
        if (nodes.s2[j] < thinner * thinner) {
            r[j] = fresnel(n_above, n_below, std::sqrt(1 - nodes.s2[j] / (n_above * n_above)));
            t[j] = 1 - r[j];
        }
    return {r.asDiagonal(), r.asDiagonal(), t.asDiagonal(), t.asDiagonal()};
}

// The even and the odd part of the azimuth-averaged phase function between the layer's cosines, sum over m of
// (2m+1) chi_m P_m(mu_i) P_m(mu_j), with the peak |g|^M removed (delta-M, Wiscombe 1977). For g < 0 the odd
// part changes sign.
void phase_function(double g, double peak, int moments, const ArrayXd& mu, MatrixXd& even, MatrixXd& odd)
{
    const Eigen::Index count = mu.size();
    even = odd = MatrixXd::Zero(count, count);
    ArrayXd p = ArrayXd::Ones(count), before = ArrayXd::Zero(count);
    double power = 1; // of |g|
    for (int m = 0; m < moments; ++m) {
        const double chi = (power - peak) / (1 - peak);
        (m % 2 == 0 ? even : odd) += (2 * m + 1) * chi * p.matrix() * p.matrix().transpose();
        const ArrayXd next = ((2 * m + 1) * mu * p - m * before) / (m + 1);
        before = p;
        p = next;
        power *= std::abs(g);
    }
    if (g < 0)
        odd = -odd;
}

// The layer's modes: B = L L', L' C L = Q k^2 Q', in order of increasing k.
struct Modes
{
    MatrixXd L, Q;
    ArrayXd k;
    VectorXd isotropic; // isotropic light in these modes: Q' L^-1 isotropic
};

// Only absorption removes isotropic light (`isotropic` in the symmetric scaling): C isotropic = absorbed. Its
// mode has k = 0 without absorption, and with little absorption a k so small that rounding in C would destroy
// it. So a Householder reflection maps this mode to the first axis, and the identity fills that row and
// column.
Modes layer_modes(const MatrixXd& B, const MatrixXd& C, const VectorXd& isotropic, const VectorXd& absorbed)
{
    Modes modes{.L = B.llt().matrixL(), .Q = {}, .k = {}, .isotropic = {}};
    const VectorXd slow = modes.L.triangularView<Eigen::Lower>().solve(isotropic);
    VectorXd axis = slow / slow.norm();
    const double sign = axis[0] > 0 ? -1 : 1;
    axis[0] -= sign;
    const auto reflect = [&](const MatrixXd& m) -> MatrixXd {
        return m - axis * (2 / axis.squaredNorm() * axis.transpose() * m);
    };
    MatrixXd turned = reflect(reflect(modes.L.transpose() * C * modes.L).transpose());
    turned.col(0) = reflect(modes.L.transpose() * absorbed) * (sign / slow.norm());
    turned(0, 0) = isotropic.dot(absorbed) / slow.squaredNorm();
    turned.row(0) = turned.col(0).transpose();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(turned);
    modes.Q = reflect(solver.eigenvectors());
    modes.k = solver.eigenvalues().array().max(0).sqrt();
    modes.isotropic = sign * slow.norm() * solver.eigenvectors().row(0).transpose();
    return modes;
}

// R + T and R - T of a layer of half the optical thickness `half`.
struct SumDifference
{
    MatrixXd sum, difference;
    VectorXd lost; // isotropic' (I - R - T)
};

SumDifference respond(const Modes& modes, double half)
{
    const Eigen::Index count = modes.k.size();
    const MatrixXd I = MatrixXd::Identity(count, count);
    const ArrayXd tanh = (modes.k * half).tanh();
    const MatrixXd inverse = modes.L.transpose().triangularView<Eigen::Upper>().solve(modes.Q);
    const MatrixXd Y = inverse * (modes.k * tanh).matrix().asDiagonal() * inverse.transpose();
    // tanh(k half) / k of the first mode may be huge; its part of W is added by the Sherman-Morrison formula.
    ArrayXd tanhc = (modes.k > 1e-8 / half).select(tanh / modes.k.max(1e-300), half);
    const double first = std::exchange(tanhc[0], 0);
    const MatrixXd LQ = modes.L * modes.Q;
    const MatrixXd W = LQ * tanhc.matrix().asDiagonal() * LQ.transpose();
    MatrixXd inverted = (I + W).llt().solve(I);
    const VectorXd shifted = inverted * LQ.col(0);
    inverted -= shifted * shifted.transpose() / (1 / first + LQ.col(0).dot(shifted));
    const auto reduced = (I + Y).llt();
    const VectorXd absorbed = inverse * (modes.k * tanh * modes.isotropic.array()).matrix();
    return {
        .sum = I - 2 * reduced.solve(Y), .difference = I - 2 * inverted, .lost = 2 * reduced.solve(absorbed)};
}

// A layer of any thickness in closed form, the limit of doubling from an infinitely thin layer. For the sum S
// and difference D of the two directions, S' = -B D and D' = -C S with B and C symmetric; the even and the
// odd solution give R + T and R - T. Lengths are optical, so that no coefficient underflows.
Operator layer_operator(const Nodes& nodes, const LayerOptics& layer, int angles)
{
    const Eigen::Index all = nodes.s2.size();
    std::vector<Eigen::Index> inside; // nodes this layer carries
    for (Eigen::Index j = 0; j < all; ++j)
        if (nodes.s2[j] < layer.n * layer.n)
            inside.push_back(j);
    const ArrayXd mu = (1 - nodes.s2(inside) / (layer.n * layer.n)).sqrt();
    const ArrayXd flux = nodes.weight(inside) / (layer.n * layer.n); // mu dmu
    const ArrayXd dmu = flux / mu;
    const auto count = static_cast<Eigen::Index>(inside.size());

    const double g = std::clamp(layer.g, -0.99, 0.99);
    const int moments = 2 * angles;
    const double peak = std::pow(g, moments), sigma_s = layer.sigma_s_reduced / (1 - g);
    const double scattering = sigma_s * (1 - peak), extinction = layer.sigma_a + scattering;
    // Beyond 1e12 only rounding changes; 1e12 also represents an infinite layer.
    const double half = extinction > 0 ? 0.5 * std::min(extinction * layer.thickness_mm, 1e12) : 0;
    SumDifference response{.sum = MatrixXd::Identity(count, count), // of an empty layer
                           .difference = -MatrixXd::Identity(count, count),
                           .lost = VectorXd::Zero(count)};
    if (half > 0) {
        MatrixXd even, odd;
        phase_function(g, peak, moments, mu, even, odd);
        // The quadrature must conserve energy exactly: the diagonal gets what the even part's sum lacks of 1.
        even.diagonal().array() += (1 - (even * dmu.matrix()).array()) / dmu;
        const VectorXd scale = (dmu / mu).sqrt();
        const MatrixXd pair = scattering / extinction * scale * scale.transpose();
        const VectorXd loss = 1 / mu;
        // A forward peak leaves light unscattered; a backward peak changes the sign of a difference.
        const double turned = g < 0 ? 2 * peak * sigma_s / extinction : 0;
        MatrixXd B = -odd.cwiseProduct(pair), C = -even.cwiseProduct(pair);
        B.diagonal() += (1 + turned) * loss;
        C.diagonal() += loss;
        response = respond(layer_modes(B, C, flux.sqrt(), layer.sigma_a / extinction * scale), half);
    }
    const VectorXd root = flux.sqrt();
    const MatrixXd to_flux = root * root.cwiseInverse().transpose();
    MatrixXd r = (0.5 * (response.sum + response.difference)).cwiseProduct(to_flux);
    MatrixXd t = (0.5 * (response.sum - response.difference)).cwiseProduct(to_flux);
    // Rounding errors of nodes of little weight: scale each column so that it absorbs exactly its known loss.
    for (Eigen::Index j = 0; j < count; ++j)
        if (const double kept = 1 - response.lost[j] / root[j]; kept > 0.5) {
            const double factor = kept / (r.col(j).sum() + t.col(j).sum());
            r.col(j) *= factor;
            t.col(j) *= factor;
        }
    Operator result;
    result.r_top = result.t_down = MatrixXd::Zero(all, all);
    result.r_top(inside, inside) = r;
    result.t_down(inside, inside) = t;
    result.r_bottom = result.r_top;
    result.t_up = result.t_down;
    return result;
}

} // namespace

Response adding_doubling(const Stack& stack, const ReflectanceOptions& options)
{
    const int angles = std::clamp(options.angles, 2, 64);
    const Nodes nodes = make_nodes(stack, angles, options.quadrature);
    std::vector<Operator> list;
    double above = stack.n_above;
    for (const LayerOptics& layer : stack.layers) {
        list.push_back(boundary(nodes, above, layer.n));
        list.push_back(layer_operator(nodes, layer, angles));
        above = layer.n;
    }
    list.push_back(boundary(nodes, above, stack.n_below));

    // Upward: the reflection of everything under each element; no light comes from below.
    const Eigen::Index count = nodes.s2.size();
    const MatrixXd I = MatrixXd::Identity(count, count);
    std::vector<MatrixXd> under(list.size() + 1, MatrixXd::Zero(count, count));
    for (std::size_t i = list.size(); i-- > 0;) {
        const Operator& e = list[i];
        const MatrixXd& r = under[i + 1];
        under[i] = e.r_top + e.t_up * (I - r * e.r_bottom).partialPivLu().solve(r * e.t_down);
    }

    // Downward: the flux that arrives at each element.
    VectorXd down = VectorXd::Zero(count);
    if (options.incidence == Incidence::Normal)
        down[0] = 1;
    else
        for (Eigen::Index j = 1; j < count; ++j)
            down[j] = nodes.s2[j] < stack.n_above * stack.n_above ? nodes.weight[j] : 0;
    down /= down.sum();

    Response response;
    response.r = std::clamp((under[0] * down).sum(), 0.0, 1.0); // rounding
    const double specular = (list[0].r_top * down).sum();
    response.r_without_specular = std::max(0.0, response.r - specular);
    double entering = 1 - response.r;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const MatrixXd& r = under[i + 1];
        down = (I - list[i].r_bottom * r).partialPivLu().solve(list[i].t_down * down).eval();
        const double leaving = down.sum() - (r * down).sum();
        if (i % 2 == 1)
            response.absorbed.push_back(std::max(0.0, entering - leaving));
        entering = leaving;
    }
    response.t = std::clamp(entering, 0.0, 1.0);
    return response;
}

} // namespace optics
