#include <snug/qp/free_rows.h>

#include <algorithm>

namespace snug::qp {
double FrictionCone::limit(const MultiVector &lambda) const
{
  return lambda(normal) > 0. ? coefficient * lambda(normal) + bound : 0.;
}

FrictionCone FrictionCone::acting(const MultiVector &lambda) const
{
  FrictionCone result = *this;
  if (other_normal && lambda(normal) > 0. && lambda(*other_normal) > 0.)
    result.n_tangents = n_along_both;
  return result;
}

double FrictionCone::compliance(const std::vector<double> &diagonal) const
{
  double largest = 0.;
  for (unsigned int t = 0; t < n_tangents; ++t)
    largest = std::max(largest, diagonal[tangents[t]]);
  return largest;
}

std::array<double, 2> FrictionCone::trial_force(const double       compliance,
                                                const MultiVector &lambda,
                                                const MultiVector &w) const
{
  std::array<double, 2> x = {};
  for (unsigned int t = 0; t < n_tangents; ++t)
    x[t] = lambda(tangents[t]) + w(tangents[t]) / compliance;
  return x;
}

FrictionCones::FrictionCones(std::vector<FrictionCone> the_cones) : cones(std::move(the_cones))
{
  for (unsigned int i = 0; i < cones.size(); ++i)
    place.insert(cones[i].normal, i);
}

void free_tangents(const FrictionCones &cones, RowSet &rows)
{
  for (const FrictionCone &cone : cones)
    for (unsigned int t = 0; t < cone.n_tangents; ++t)
      rows[cone.tangents[t]] = 0;
  for (const FrictionCone &cone : cones)
    for (unsigned int t = 0; t < cone.n_free_tangents(rows); ++t)
      rows[cone.tangents[t]] = 1;
}

FreeRows::FreeRows(RowSet rows, std::vector<Slip> slips, const bool the_transposed)
  : flags(std::move(rows)), slipping(std::move(slips)), transposed(the_transposed)
{
  for (unsigned int i = 0; i < slipping.size(); ++i)
    place.insert(slipping[i].cone.normal, i);
}

void FreeRows::restrict(MultiVector &x) const
{
  for (unsigned int k = 0; k < x.n_columns(); ++k)
    {
      std::vector<double> parts;
      for (const Slip &slip : slipping)
        if (slip.cone.n_tangents == 2)
          parts.push_back(slip.across()[0] * x(slip.cone.tangents[0], k) +
                          slip.across()[1] * x(slip.cone.tangents[1], k));
      for (unsigned int row = 0; row < x.n_rows(); ++row)
        if (!flags[row])
          x(row, k) = 0.;
      auto part = parts.begin();
      for (const Slip &slip : slipping)
        if (slip.cone.n_tangents == 2)
          {
            for (unsigned int t = 0; t < 2; ++t)
              x(slip.cone.tangents[t], k) = slip.across()[t] * *part;
            ++part;
          }
    }
}

void FreeRows::expand(MultiVector &y) const
{
  if (transposed)
    return;
  for (const Slip &slip : slipping)
    for (unsigned int k = 0; k < y.n_columns(); ++k)
      for (unsigned int t = 0; t < slip.cone.n_tangents; ++t)
        y(slip.cone.tangents[t], k) +=
          slip.cone.coefficient * slip.direction[t] * y(slip.cone.normal, k);
}

void FreeRows::reduce(MultiVector &r) const
{
  if (transposed)
    for (const Slip &slip : slipping)
      for (unsigned int k = 0; k < r.n_columns(); ++k)
        for (unsigned int t = 0; t < slip.cone.n_tangents; ++t)
          r(slip.cone.normal, k) +=
            slip.cone.coefficient * slip.direction[t] * r(slip.cone.tangents[t], k);
  restrict(r);
}

void FreeRows::add_compliance(const double factor, const MultiVector &y, MultiVector &r) const
{
  // y lies across the slip, so D n_perp n_perp' y = D y on the tangential rows.
  for (const Slip &slip : slipping)
    for (unsigned int k = 0; k < y.n_columns(); ++k)
      for (unsigned int t = 0; slip.cone.n_tangents == 2 && t < 2; ++t)
        r(slip.cone.tangents[t], k) += factor * slip.compliance * y(slip.cone.tangents[t], k);
}

MultiVector FreeRows::reduced_residual(const MultiVector &lambda, MultiVector residual) const
{
  reduce(residual);
  if (slipping.empty())
    return residual;
  MultiVector y = lambda;
  restrict(y);
  add_compliance(-1., y, residual);
  return residual;
}
} // namespace snug::qp
