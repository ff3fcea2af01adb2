#include <snug/supports/constraint_frame.h>

#include <algorithm>

namespace snug::supports {
template <int dim>
void ConstraintFrames<dim>::reserve(const std::size_t n_nodes, const std::size_t n_directions)
{
  start.reserve(n_nodes + 1);
  all_directions.reserve(n_directions);
  values.reserve(n_directions * n_cases);
}

template <int dim>
void ConstraintFrames<dim>::push_back(const ConstraintFrame<dim> &frame)
{
  all_directions.insert(all_directions.end(), frame.directions.begin(), frame.directions.end());
  for (const auto &of_direction : frame.values)
    values.insert(values.end(), of_direction.begin(), of_direction.end());
  start.push_back(static_cast<unsigned int>(all_directions.size()));
}

template <int dim>
void ConstraintFrames<dim>::add(const double factor, const ConstraintFrames &other)
{
  for (std::size_t i = 0; i < all_directions.size(); ++i)
    all_directions[i] += factor * other.all_directions[i];
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] += factor * other.values[i];
}

// Gram-Schmidt keeps the order: the first direction stays as given, so that axes stay axes. The
// prescribed values are transformed with the directions, because q_k . u = s_k must be equivalent
// to d_j . u = v_j. L holds the factors, d = L q, for the derivatives and for the inverse
// transformation.
template <int dim>
Orthonormalised<dim>::Orthonormalised(const ConstraintFrame<dim> &given)
{
  auto &q = orthonormal.directions;
  auto &s = orthonormal.values;
  for (unsigned int j = 0; j < given.directions.size(); ++j)
    {
      auto v     = given.directions[j];
      auto value = given.values[j];
      L.emplace_back();
      for (unsigned int k = 0; k < j; ++k)
        {
          L[j].push_back(given.directions[j] * q[k]);
          v -= L[j][k] * q[k];
          for (unsigned int c = 0; c < value.size(); ++c)
            value[c] -= L[j][k] * s[k][c];
        }
      L[j].push_back(v.norm());
      q.push_back(v / L[j][j]);
      for (double &entry : value)
        entry /= L[j][j];
      s.push_back(value);
    }
}

// The diagonal of L is the sine of the angle between a direction and the span of those before it.
template <int dim>
double Orthonormalised<dim>::independence() const
{
  double smallest = 1.;
  for (const auto &row : L)
    smallest = std::min(smallest, row.back());
  return smallest;
}

template <int dim>
ConstraintFrame<dim> Orthonormalised<dim>::derivative(const ConstraintFrame<dim> &given) const
{
  const auto          &q = orthonormal.directions;
  const auto          &s = orthonormal.values;
  ConstraintFrame<dim> result;
  auto                &dq = result.directions;
  auto                &ds = result.values;
  for (unsigned int j = 0; j < q.size(); ++j)
    {
      // d_j as given, reconstructed from its parts
      dealii::Tensor<1, dim> d = L[j][j] * q[j];
      for (unsigned int k = 0; k < j; ++k)
        d += L[j][k] * q[k];
      auto dv     = given.directions[j];
      auto dvalue = given.values[j];
      for (unsigned int k = 0; k < j; ++k)
        {
          // L_jk = d_j . q_k, where both factors change
          const double dL = given.directions[j] * q[k] + d * dq[k];
          dv -= dL * q[k] + L[j][k] * dq[k];
          for (unsigned int c = 0; c < dvalue.size(); ++c)
            dvalue[c] -= dL * s[k][c] + L[j][k] * ds[k][c];
        }
      const double dlength = q[j] * dv;
      dq.push_back((dv - dlength * q[j]) / L[j][j]);
      for (unsigned int c = 0; c < dvalue.size(); ++c)
        dvalue[c] = (dvalue[c] - dlength * s[j][c]) / L[j][j];
      ds.push_back(dvalue);
    }
  return result;
}

// Solve L' m = mu by back substitution, because
// sum_k mu_k (q_k . u - s_k) = sum_j m_j (d_j . u - v_j).
template <int dim>
std::vector<double> Orthonormalised<dim>::given_multipliers(std::vector<double> multipliers) const
{
  for (unsigned int j = multipliers.size(); j-- > 0;)
    {
      for (unsigned int i = j + 1; i < multipliers.size(); ++i)
        multipliers[j] -= L[i][j] * multipliers[i];
      multipliers[j] /= L[j][j];
    }
  return multipliers;
}

template class ConstraintFrames<2>;
template class ConstraintFrames<3>;
template class Orthonormalised<2>;
template class Orthonormalised<3>;
} // namespace snug::supports
