#ifndef snug_tests_qp_friction_cases_h
#define snug_tests_qp_friction_cases_h

#include "dense_problem.h"

#include <array>

/// A body on a rigid plane that it touches at some points, as a dense problem.
struct FrictionCase
{
  unsigned int n_contacts = 12, n_tangents = 2;
  unsigned int n_glued     = 4; ///< other equality rows
  double       coefficient = 0.3;
  double       bound       = 0.;   ///< of Tresca friction
  double       contrast    = 10.;  ///< of the compliances of the rows
  double       shear       = 0.5;  ///< load along the plane over coefficient x normal load
  bool         floating    = true; ///< only contacts hold the body
  unsigned int seed        = 0;
};

/// Return D (I / 2 + A A' / n) D with random A and D.
inline dense::Matrix random_flexibility(unsigned int n, double contrast, std::mt19937 &generator)
{
  std::uniform_real_distribution<double> uniform(0., 1.);
  const auto                             A = dense::random(n, n, generator);
  auto                                   F = dense::product(A, dense::transpose(A));
  std::vector<double>                    scale(n);
  for (double &s : scale)
    s = std::pow(contrast, uniform(generator) - 0.5);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
      F(i, j) = scale[i] * scale[j] * (F(i, j) / n + (i == j ? 0.5 : 0.));
  return F;
}

/// Set the columns of G of a contact at (x, y, 0), with rows along -z, x and y: the body lies above
/// the plane.
inline void
set_contact_motions(const snug::qp::FrictionCone &cone, double x, double y, dense::Matrix &G)
{
  if (cone.n_tangents == 1)
    {
      G(1, cone.normal)      = -1.; // force along x and z, moment about y
      G(2, cone.normal)      = x;
      G(0, cone.tangents[0]) = 1.;
      return;
    }
  G(2, cone.normal)      = -1.;
  G(3, cone.normal)      = -y;
  G(4, cone.normal)      = x;
  G(0, cone.tangents[0]) = 1.;
  G(1, cone.tangents[1]) = 1.;
  G(5, cone.tangents[0]) = -y;
  G(5, cone.tangents[1]) = x;
}

/// Rows are [glued, then normal and tangents of each contact].
inline DenseData friction_data(const FrictionCase &of)
{
  std::mt19937                           generator(1000 + of.seed);
  std::uniform_real_distribution<double> uniform(0., 1.);
  const unsigned int                     per = 1 + of.n_tangents;
  const unsigned int                     n   = of.n_glued + per * of.n_contacts;
  const unsigned int                     m   = of.floating ? (of.n_tangents == 2 ? 6 : 3) : 0;
  DenseData                              data;
  data.F = random_flexibility(n, of.contrast, generator);
  data.bounded.assign(n, 0);
  data.d = dense::Matrix(n);
  data.G = dense::Matrix(m, n);
  data.e = dense::Matrix(m);
  for (unsigned int i = 0; i < of.n_contacts; ++i)
    {
      snug::qp::FrictionCone cone;
      cone.normal      = of.n_glued + per * i;
      cone.n_tangents  = of.n_tangents;
      cone.coefficient = of.bound > 0. ? 0. : of.coefficient;
      cone.bound       = of.bound;
      for (unsigned int t = 0; t < of.n_tangents; ++t)
        cone.tangents[t] = cone.normal + 1 + t;
      data.bounded[cone.normal] = 1;
      data.cones.push_back(cone);
      // -gap, and the loads of a held body
      data.d(cone.normal) = -0.2 * uniform(generator) + (of.floating ? 0. : 1.);
      for (unsigned int t = 0; t < of.n_tangents; ++t)
        data.d(cone.tangents[t]) =
          of.floating ? 0. : of.shear * of.coefficient * (2. * uniform(generator) - 0.5);
      const double x = 2. * uniform(generator) - 1.;
      const double y = of.n_tangents == 2 ? 2. * uniform(generator) - 1. : 0.;
      if (of.floating)
        set_contact_motions(cone, x, y, data.G);
    }
  for (unsigned int i = 0; i < of.n_glued; ++i)
    data.d(i) = 2. * uniform(generator) - 1.;
  if (m > 0)
    {
      const double P = of.n_contacts, Q = of.shear * of.coefficient * P;
      data.e(m == 3 ? 1 : 2) = -P;
      data.e(0)              = m == 3 ? Q : 0.8 * Q;
      if (m == 6)
        data.e(1) = 0.6 * Q;
    }
  return data;
}

/// Violation of the conditions of a state with friction, recomputed from the data alone.
struct FrictionErrors
{
  double equations = 0., normal = 0., cone = 0., slip = 0.;
  double worst() const { return std::max({equations, normal, cone, slip}); }
};

inline FrictionErrors
friction_errors(const DenseData &data, const dense::Matrix &lambda, const dense::Matrix &alpha)
{
  FrictionErrors errors;
  auto           w = data.d;
  w.add(-1., dense::product(data.F, lambda));
  if (data.G.n_rows() > 0)
    {
      w.add(1., dense::product(dense::transpose(data.G), alpha));
      auto missing = data.e;
      missing.add(-1., dense::product(data.G, lambda));
      errors.equations = dense::largest(missing);
    }
  std::vector<bool> is_contact(lambda.n_rows(), false);
  for (const auto &cone : data.cones)
    {
      const unsigned int N    = cone.normal;
      is_contact[N]           = true;
      std::array<double, 2> f = {}, s = {};
      for (unsigned int t = 0; t < cone.n_tangents; ++t)
        {
          is_contact[cone.tangents[t]] = true;
          f[t]                         = lambda(cone.tangents[t]);
          s[t]                         = w(cone.tangents[t]);
        }
      errors.normal      = std::max({errors.normal, -lambda(N), w(N), std::abs(lambda(N) * w(N))});
      const double limit = cone.limit(lambda), force = std::hypot(f[0], f[1]);
      const double slip = std::hypot(s[0], s[1]);
      errors.cone       = std::max(errors.cone, force - limit);
      errors.slip       = std::max(errors.slip, limit * slip - f[0] * s[0] - f[1] * s[1]);
    }
  for (unsigned int i = 0; i < lambda.n_rows(); ++i)
    if (!is_contact[i])
      errors.equations = std::max(errors.equations, std::abs(w(i)));
  return errors;
}

/// Projected block Gauss-Seidel for a problem without G: one contact after the other.
inline dense::Matrix gauss_seidel(const DenseData &data, const unsigned int sweeps)
{
  const unsigned int n = data.F.n_rows();
  dense::Matrix      lambda(n);
  const auto         w = [&](const unsigned int i) {
    double sum = data.d(i);
    for (unsigned int j = 0; j < n; ++j)
      sum -= data.F(i, j) * lambda(j);
    return sum;
  };
  std::vector<bool> is_contact(n, false);
  for (const auto &cone : data.cones)
    {
      is_contact[cone.normal] = true;
      for (unsigned int t = 0; t < cone.n_tangents; ++t)
        is_contact[cone.tangents[t]] = true;
    }
  for (unsigned int sweep = 0; sweep < sweeps; ++sweep)
    {
      for (unsigned int i = 0; i < n; ++i)
        if (!is_contact[i])
          lambda(i) += w(i) / data.F(i, i);
      for (const auto &cone : data.cones)
        {
          const unsigned int N = cone.normal;
          lambda(N)            = std::max(lambda(N) + w(N) / data.F(N, N), 0.);
          const double limit   = cone.limit(lambda);
          // A projected gradient step of the tangential rows.
          double F = 0.;
          for (unsigned int t = 0; t < cone.n_tangents; ++t)
            for (unsigned int k = 0; k < cone.n_tangents; ++k)
              F += std::abs(data.F(cone.tangents[t], cone.tangents[k]));
          std::array<double, 2> x = {};
          for (unsigned int t = 0; t < cone.n_tangents; ++t)
            x[t] = lambda(cone.tangents[t]) + w(cone.tangents[t]) / F;
          const double length = std::hypot(x[0], x[1]);
          for (unsigned int t = 0; t < cone.n_tangents; ++t)
            lambda(cone.tangents[t]) = x[t] * (length > limit ? limit / length : 1.);
        }
    }
  return lambda;
}

#endif
