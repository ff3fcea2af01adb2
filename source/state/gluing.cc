#include <snug/base/narrow.h>
#include <snug/state/gluing.h>

#include <set>

namespace snug::state {
namespace {
/// A direction held at a node, q . u = s, with its derivatives.
template <int dim>
struct HeldDirection
{
  dealii::Tensor<1, dim> q, dq;
  double                 s, ds;
};

/// Return the directions held at node @p h with their derivatives. Empty derivative frames stand
/// for zero, for directions that do not follow the positions.
template <int dim>
std::vector<HeldDirection<dim>> held_directions(const supports::ConstraintFrames<dim> &frames,
                                                const supports::ConstraintFrames<dim> &derivatives,
                                                const unsigned int                     h,
                                                const unsigned int                     load_case)
{
  std::vector<HeldDirection<dim>> held;
  const auto                      q = frames.directions(h), dq = derivatives.directions(h);
  for (unsigned int k = 0; k < q.size(); ++k)
    {
      held.push_back({q[k], {}, frames.value(h, k, load_case), 0.});
      if (dq.size() == 0)
        continue;
      held[k].dq = dq[k];
      held[k].ds = derivatives.value(h, k, load_case);
    }
  return held;
}
} // namespace

template <int dim>
Gluing<dim>::Gluing(const mesh::BodyMesh<dim>                 &mesh,
                    const mesh::Tearing                       &tearing,
                    const mesh::Surface<dim>                  &surface,
                    const supports::DirichletConstraints<dim> &held,
                    const RowCoefficients<dim>                &reference,
                    const std::vector<contact::Tangent>       &tangents,
                    const Model<dim>                          &model,
                    const unsigned int                         load_case)
  : held(held)
  , model(model)
  , rows(mesh, tearing, surface, held, reference, tangents, model, load_case)
  , n_tangents(narrow<unsigned int>(tangents.size()))
  , n_ties(narrow<unsigned int>(reference.ties.size()))
{
  for (const auto &row : rows.owned)
    owned_contact.push_back(row.source == Source::contact ? row.index : reference.n_rows());
}

template <int dim>
qp::FrictionCones Gluing<dim>::cones(const contact::Contact<dim> &contact,
                                     const std::vector<double>   &areas) const
{
  std::map<unsigned int, unsigned int>     owned_of; // by RowCoefficients::row()
  std::map<unsigned int, qp::FrictionCone> cone_of;  // by normal row
  for (unsigned int row = 0; row < rows.owned.size(); ++row)
    if (rows.owned[row].source == Source::contact)
      owned_of[rows.owned[row].index] = row;
  for (unsigned int i = 0; i < contact.tangents().size(); ++i)
    {
      const unsigned int normal  = contact.tangents()[i].row;
      const auto         tangent = owned_of.find(n_contact_rows() + i);
      if (tangent == owned_of.end())
        continue;
      const auto &law                  = contact.friction(normal);
      auto       &cone                 = cone_of[normal];
      cone.normal                      = owned_of.at(normal);
      cone.coefficient                 = law.coefficient;
      cone.bound                       = law.bound * areas[normal] * rows.scales[normal];
      cone.tangents[cone.n_tangents++] = tangent->second;
      if (const auto &other = contact.other_obstacle(normal))
        {
          // The rows of a node have one owner.
          cone.other_normal = owned_of.at(other->row);
          cone.n_along_both = other->shares_first_tangent;
        }
    }
  for (auto &[row, cone] : cone_of)
    if (const auto &other = contact.other_obstacle(row); other && cone_of.count(other->row) > 0)
      if (const auto &of_other = cone_of.at(other->row); of_other.n_along_both > 0)
        cone.other_tangent = of_other.tangents[0];
  std::vector<qp::FrictionCone> result;
  for (const auto &[row, cone] : cone_of)
    result.push_back(cone);
  return result;
}

/// Return the rows with the scale zero, which scale_rows() sets for vanished rows.
template <int dim>
std::vector<unsigned int> Gluing<dim>::vanished_rows() const
{
  std::vector<unsigned int> vanished;
  for (unsigned int i = 0; i < n_contact_rows(); ++i)
    if (rows.scales[i] == 0.)
      vanished.push_back(i);
  return vanished;
}

template <int dim>
std::vector<unsigned int> Gluing<dim>::boundary(const unsigned int s) const
{
  std::set<unsigned int> unknowns;
  for (const auto &entry : rows.entries[s])
    unknowns.insert(entry.dof);
  return {unknowns.begin(), unknowns.end()};
}

/// Fill the entries of the reference geometry, also where a value happens to be zero at this
/// geometry, because the pattern of B must not depend on the design.
template <int dim>
void Gluing<dim>::fill_B(unsigned int                s,
                         const RowCoefficients<dim> &now,
                         std::vector<feti::BEntry>  &B) const
{
  B.clear();
  for (const auto &entry : rows.entries[s])
    {
      double value = entry.factor;
      if (entry.source == Source::held)
        value *= now.held.directions(entry.index)[entry.item][entry.dof % dim];
      else if (entry.source == Source::contact)
        {
          const auto &c = now.row(entry.index).coefficients[entry.item];
          value *= rows.projected(c.first, c.second, now.held)[entry.dof % dim];
        }
      else if (entry.source == Source::spring)
        value *= now.springs[entry.index].coefficients[entry.item].second[entry.dof % dim];
      else if (entry.source == Source::point)
        value *= now.points[entry.index].values[entry.item];
      B.push_back({entry.local_row, entry.dof, value});
    }
}

template <int dim>
void Gluing<dim>::fill_B_derivative(unsigned int                s,
                                    const RowCoefficients<dim> &now,
                                    const RowCoefficients<dim> &derivative,
                                    std::vector<feti::BEntry>  &B) const
{
  B.clear();
  for (const auto &entry : rows.entries[s])
    {
      double value = 0.;
      if (entry.source == Source::held)
        value = derivative.held.directions(entry.index)[entry.item][entry.dof % dim];
      else if (entry.source == Source::spring)
        value = derivative.springs[entry.index].coefficients[entry.item].second[entry.dof % dim];
      else if (entry.source == Source::point)
        value = derivative.points[entry.index].values[entry.item];
      else if (entry.source == Source::contact)
        {
          const auto        &c      = now.row(entry.index).coefficients[entry.item];
          const auto        &dc     = derivative.row(entry.index).coefficients[entry.item].second;
          auto               result = dc;
          const unsigned int h      = rows.held_of_surface[c.first];
          if (h < held.n_nodes())
            // Differentiate c <- c - sum_k (c . q_k) q_k by the product rule. 1 / nr in the factor
            // is a constant of the reference geometry. The values s do not enter B, so any load
            // case serves.
            for (const auto &d : held_directions(now.held, derivative.held, h, 0))
              result -= (dc * d.q + c.second * d.dq) * d.q + (c.second * d.q) * d.dq;
          value = result[entry.dof % dim];
        }
      B.push_back({entry.local_row, entry.dof, entry.factor * value});
    }
}

template <int dim>
double Gluing<dim>::gap_derivative(unsigned int                i,
                                   const RowCoefficients<dim> &now,
                                   const RowCoefficients<dim> &derivative,
                                   unsigned int                load_case) const
{
  double result = derivative.row(i).gap;
  for (unsigned int a = 0; a < now.row(i).coefficients.size(); ++a)
    {
      const auto        &c  = now.row(i).coefficients[a];
      const auto        &dc = derivative.row(i).coefficients[a].second;
      const unsigned int h  = rows.held_of_surface[c.first];
      if (h == held.n_nodes())
        continue;
      for (const auto &d : held_directions(now.held, derivative.held, h, load_case))
        // Differentiate the term of gap() by the product rule.
        result -= (dc * d.q + c.second * d.dq) * d.s + (c.second * d.q) * d.ds;
    }
  return result;
}

template <int dim>
qp::MultiVector Gluing<dim>::right_hand_side(const RowCoefficients<dim> &now,
                                             unsigned int                load_case) const
{
  qp::MultiVector g(rows.layout->n_owned());
  for (unsigned int i = 0; i < g.n_rows(); ++i)
    {
      const auto &row = rows.owned[i];
      if (row.source == Source::contact)
        // The factor is 1 / nr, as that of the row itself.
        g(i) = row.factor * rows.gap(row.index, now, load_case);
      else if (row.source == Source::held)
        g(i) = row.factor * now.held.value(row.index, row.item, load_case);
      else if (row.source == Source::point)
        {
          const auto &motion = rows.held_motions[row.index];
          g(i) =
            row.factor * *model.load_cases[load_case].points[motion.point].held[motion.unknown];
        }
    }
  return g;
}

template <int dim>
qp::MultiVector Gluing<dim>::right_hand_side_derivative(const RowCoefficients<dim> &now,
                                                        const RowCoefficients<dim> &derivative,
                                                        unsigned int                load_case) const
{
  qp::MultiVector g(rows.layout->n_owned());
  for (unsigned int i = 0; i < g.n_rows(); ++i)
    {
      const auto &row = rows.owned[i];
      if (row.source == Source::contact)
        g(i) = row.factor * gap_derivative(row.index, now, derivative, load_case);
      // Prescribed displacements move with the material point, and s' comes from the rotating
      // frame.
      else if (row.source == Source::held && held.follows_positions(row.index))
        g(i) = row.factor * derivative.held.value(row.index, row.item, load_case);
    }
  return g;
}

template <int dim>
std::vector<std::vector<double>> Gluing<dim>::gather_contact(const qp::MultiVector &owned) const
{
  const std::size_t   n = rows.scales.size();
  std::vector<double> values(n * owned.n_columns(), 0.);
  for (unsigned int k = 0; k < owned.n_columns(); ++k)
    for (unsigned int row = 0; row < rows.layout->n_owned(); ++row)
      if (rows.owned[row].source == Source::contact)
        values[k * n + rows.owned[row].index] = owned(row, k);
  // Each row has one owner, so every sum has one nonzero term. The result is exact and does not
  // depend on the number of ranks.
  MPI_Allreduce(MPI_IN_PLACE, values.data(), narrow<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                rows.layout->communicator());
  std::vector<std::vector<double>> result;
  for (unsigned int k = 0; k < owned.n_columns(); ++k)
    result.emplace_back(values.begin() + k * n, values.begin() + (k + 1) * n);
  return result;
}

template <int dim>
std::vector<typename Gluing<dim>::RowForces>
Gluing<dim>::row_forces(const qp::MultiVector &multipliers) const
{
  std::vector<RowForces> result;
  for (auto &forces : gather_contact(multipliers))
    {
      for (std::size_t i = 0; i < forces.size(); ++i)
        // A row that supports hold entirely has no multiplier.
        forces[i] = rows.scales[i] == 0. ? 0. : forces[i] / rows.scales[i];
      const auto ties = forces.begin() + rows.n_bounded;
      result.push_back({{forces.begin(), ties}, {ties, ties + n_ties}, forces});
    }
  return result;
}

template <int dim>
std::vector<std::vector<double>>
Gluing<dim>::contact_forces(const qp::MultiVector &multipliers) const
{
  std::vector<std::vector<double>> result;
  for (auto &forces : row_forces(multipliers))
    result.push_back(std::move(forces.contact));
  return result;
}

template <int dim>
std::vector<std::vector<double>> Gluing<dim>::reactions(const qp::MultiVector      &lambda,
                                                        const RowCoefficients<dim> &now) const
{
  std::vector<double> values(dim * held.n_nodes(), 0.);
  for (unsigned int row = 0; row < rows.owned.size(); ++row)
    if (rows.owned[row].source == Source::held)
      // Once the copies are equal, row and right-hand side are sqrt(m) times q . u = s.
      values[dim * rows.owned[row].index + rows.owned[row].item] =
        rows.owned[row].factor * lambda(row);
  MPI_Allreduce(MPI_IN_PLACE, values.data(), values.size(), MPI_DOUBLE, MPI_SUM,
                rows.layout->communicator());
  // lambda_i / nr_i (projected c . u - projected gap) contains -(c . q_k) (q_k . u - s_k) in
  // addition to c . u - gap, and this part goes to the supports. Add it after the sum over ranks,
  // because gathered multipliers are the same on all ranks.
  const auto forces = row_forces(lambda).front().all;
  for (unsigned int i = 0; i < forces.size(); ++i)
    for (const auto &c : now.row(i).coefficients)
      {
        const unsigned int h = rows.held_of_surface[c.first];
        if (h == held.n_nodes())
          continue;
        const auto directions = now.held.directions(h);
        for (unsigned int k = 0; k < directions.size(); ++k)
          values[dim * h + k] -= forces[i] * (c.second * directions[k]);
      }
  std::vector<std::vector<double>> result;
  for (unsigned int h = 0; h < held.n_nodes(); ++h)
    result.emplace_back(values.begin() + dim * h,
                        values.begin() + dim * h + now.held.directions(h).size());
  return result;
}

template <int dim>
std::vector<double> Gluing<dim>::compliances(const RowCoefficients<dim> &now) const
{
  const bool          any = !now.springs.empty() || !rows.held_tangents.empty();
  std::vector<double> D(any ? rows.owned.size() : 0, 0.);
  for (unsigned int i = 0; i < D.size(); ++i)
    {
      const auto &row = rows.owned[i];
      if (row.source == Source::spring)
        D[i] = row.factor * row.factor / now.springs[row.index].stiffness;
      else if (const auto held_tangent = rows.held_tangents.find(row.index);
               row.source == Source::contact && held_tangent != rows.held_tangents.end())
        D[i] = row.factor * row.factor / held_tangent->second;
    }
  return D;
}

template <int dim>
std::vector<double>
Gluing<dim>::compliance_derivatives(const RowCoefficients<dim> &now,
                                    const RowCoefficients<dim> &derivative) const
{
  auto D = compliances(now);
  for (unsigned int i = 0; i < D.size(); ++i)
    {
      const auto &row = rows.owned[i];
      D[i] *= row.source == Source::spring
                ? -derivative.springs[row.index].stiffness / now.springs[row.index].stiffness
                : 0.;
    }
  return D;
}

template <int dim>
std::vector<double> Gluing<dim>::spring_forces(const double *owned_lambda) const
{
  // All ranks know the springs, but only the owner of a row knows its scale.
  std::vector<double> forces(rows.spring_scales.size(), 0.);
  for (unsigned int i = 0; i < rows.owned.size(); ++i)
    if (const auto &row = rows.owned[i]; row.source == Source::spring)
      forces[row.index] = row.factor * owned_lambda[i];
  MPI_Allreduce(MPI_IN_PLACE, forces.data(), narrow<int>(forces.size()), MPI_DOUBLE, MPI_SUM,
                rows.layout->communicator());
  return forces;
}

template class Gluing<2>;
template class Gluing<3>;
} // namespace snug::state
