#include <snug/base/narrow.h>
#include <snug/state/gluing.h>

namespace snug::state {
template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
Gluing<dim>::locked_rows(const unsigned int load_case) const
{
  std::vector<std::pair<unsigned int, unsigned int>> result;
  for (unsigned int row = 0; row < rows.owned.size(); ++row)
    if (rows.owned[row].source == Source::point)
      {
        const auto [point, unknown] = rows.held_motions[rows.owned[row].index];
        const auto &load            = model.load_cases[load_case].points[point];
        if (!load.locked.empty() && load.locked[unknown])
          result.emplace_back(row, n_tangents + point * load.held.size() + unknown);
      }
  return result;
}

template <int dim>
void Gluing<dim>::add_step(const std::vector<double> &values,
                           const unsigned int         load_case,
                           qp::MultiVector           &g) const
{
  for (const auto &[row, place] : locked_rows(load_case))
    g(row) += values[place];
  for (unsigned int row = 0; row < rows.owned.size(); ++row)
    if (const auto &of = rows.owned[row];
        of.source == Source::contact && of.index >= n_contact_rows() && of.index < rows.n_bounded)
      g(row) += of.factor * values[of.index - n_contact_rows()];
}

template <int dim>
std::vector<std::vector<double>> Gluing<dim>::point_reactions(const double *owned_lambda) const
{
  std::vector<double> values(rows.held_motions.size(), 0.);
  for (unsigned int i = 0; i < rows.owned.size(); ++i)
    if (rows.owned[i].source == Source::point)
      values[rows.owned[i].index] = -owned_lambda[i] * rows.owned[i].factor;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), narrow<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                rows.layout->communicator());
  std::vector<std::vector<double>> result(model.points.size(), std::vector<double>(6, 0.));
  for (unsigned int i = 0; i < values.size(); ++i)
    result[rows.held_motions[i].point][rows.held_motions[i].unknown] = values[i];
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                           \
  template std::vector<std::pair<unsigned int, unsigned int>> Gluing<dim>::locked_rows( \
    unsigned int) const;                                                                \
  template void Gluing<dim>::add_step(const std::vector<double> &, unsigned int,        \
                                      qp::MultiVector &) const;                         \
  template std::vector<std::vector<double>> Gluing<dim>::point_reactions(const double *) const;
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::state
