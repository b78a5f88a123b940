#include "wound/adding_doubling.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "wound/fresnel.hpp"

namespace wound {

namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Directions are named by s = n sin(theta), which refraction leaves alone, so one set of nodes serves all
// layers and a boundary never mixes nodes. All vectors hold the flux of a node. Node 0 is the normal
// direction, with next to no weight of its own.
struct Nodes
{
    ArrayXd s2;     // s squared
    ArrayXd weight; // of s ds: what isotropic light of unit radiance / n^2 carries
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
        // The variable is the cosine in a medium of index n, from that of the panel's end to that of its
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
    // Total reflection falls short of 1 by next to nothing, lest light trapped in a clear layer, which none
    // ever is, made the round trip's matrix singular.
    VectorXd r = VectorXd::Constant(count, 1 - 1e-13), t = VectorXd::Zero(count);
    for (Eigen::Index j = 0; j < count; ++j)
        if (nodes.s2[j] < thinner * thinner) {
            r[j] = fresnel(n_above, n_below, std::sqrt(1 - nodes.s2[j] / (n_above * n_above)));
            t[j] = 1 - r[j];
        }
    return {r.asDiagonal(), r.asDiagonal(), t.asDiagonal(), t.asDiagonal()};
}

// The even and the odd part of the azimuth-averaged phase function between the layer's cosines, sum over m of
// (2m+1) chi_m P_m(mu_i) P_m(mu_j), with the forward peak g^M taken out (delta-M, Wiscombe 1977).
void phase_function(double g, double peak, int moments, const ArrayXd& mu, MatrixXd& even, MatrixXd& odd)
{
    const Eigen::Index count = mu.size();
    even = odd = MatrixXd::Zero(count, count);
    ArrayXd p = ArrayXd::Ones(count), before = ArrayXd::Zero(count);
    double power = 1;
    for (int m = 0; m < moments; ++m) {
        const double chi = (power - peak) / (1 - peak);
        (m % 2 == 0 ? even : odd) += (2 * m + 1) * chi * p.matrix() * p.matrix().transpose();
        const ArrayXd next = ((2 * m + 1) * mu * p - m * before) / (m + 1);
        before = p;
        p = next;
        power *= g;
    }
}

// A layer of any thickness in closed form: what doubling converges to when it starts infinitely thin. With
// sums S and differences D of the two directions, S' = -B D and D' = -C S, B and C symmetric; R + T and R - T
// follow from the even and the odd solution.
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
    const double sigma_s = layer.sigma_s_reduced / (1 - g);
    const int moments = 2 * angles;
    const double peak = std::pow(g, moments);
    MatrixXd even, odd;
    phase_function(g, peak, moments, mu, even, odd);
    // The quadrature must conserve light exactly: what the even part lacks of 1 goes into its diagonal.
    even.diagonal().array() += (1 - (even * dmu.matrix()).array()) / dmu;

    const double scattering = sigma_s * (1 - peak), extinction = layer.sigma_a + scattering;
    const VectorXd scale = (dmu / mu).sqrt();
    const MatrixXd pair = scale * scale.transpose();
    const MatrixXd loss = (extinction / mu).matrix().asDiagonal();
    const MatrixXd B = loss - scattering * odd.cwiseProduct(pair),
                   C = loss - scattering * even.cwiseProduct(pair);

    Operator result;
    result.r_top = result.t_down = MatrixXd::Zero(all, all);
    // Thicker than this nothing changes but rounding; it also stands for an infinite layer.
    const double half =
        0.5 * std::min(layer.thickness_mm, 1e7 / std::max(layer.sigma_a + layer.sigma_s_reduced, 1e-30));
    MatrixXd sum = MatrixXd::Identity(count, count), difference = -sum; // R + T, R - T of an empty layer
    if (extinction * half > 0) {
        const MatrixXd L = B.llt().matrixL();
        const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(L.transpose() * C * L);
        const ArrayXd k = modes.eigenvalues().array().max(0).sqrt();
        const ArrayXd kh = k * half;
        const ArrayXd tanhc = (kh > 1e-8).select(kh.tanh() / kh.max(1e-300), 1.0) * half; // tanh(k h) / k
        const MatrixXd LQ = L * modes.eigenvectors();
        const MatrixXd inverse = L.transpose().triangularView<Eigen::Upper>().solve(modes.eigenvectors());
        const MatrixXd W = LQ * tanhc.matrix().asDiagonal() * LQ.transpose();
        const MatrixXd Y = inverse * (k * k * tanhc).matrix().asDiagonal() * inverse.transpose();
        const MatrixXd I = MatrixXd::Identity(count, count);
        sum = 2 * (I + Y).llt().solve(I) - I;
        difference = I - 2 * (I + W).llt().solve(I);
    }
    const VectorXd root = flux.sqrt();
    const MatrixXd to_flux = root * root.cwiseInverse().transpose();
    result.r_top(inside, inside) = (0.5 * (sum + difference)).cwiseProduct(to_flux);
    result.t_down(inside, inside) = (0.5 * (sum - difference)).cwiseProduct(to_flux);
    result.r_bottom = result.r_top;
    result.t_up = result.t_down;
    return result;
}

} // namespace

Response adding_doubling(const Stack& stack, const RungOptions& options)
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

    // Upward: the reflection of all that lies under each element, nothing coming from below.
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
    response.r = (under[0] * down).sum();
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
    response.t = std::max(0.0, entering);
    return response;
}

} // namespace wound
