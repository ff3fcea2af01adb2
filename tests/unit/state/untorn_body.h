#ifndef snug_tests_unit_state_untorn_body_h
#define snug_tests_unit_state_untorn_body_h

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe_field.h>
#include <deal.II/fe/mapping_q1.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <unit/state/test_scene.h>

#include <array>

namespace snug::test {
/// Integer coordinates by which nodes of different meshes are matched.
template <int dim>
std::array<long, dim> node_key(const dealii::Tensor<1, dim> &x)
{
  std::array<long, dim> key;
  for (unsigned int d = 0; d < dim; ++d)
    key[d] = std::lround(x[d] * 1e6 + 0.2137);
  return key;
}

/// One body of a test scene in deal.II's own terms, on every rank whole.
template <int dim>
class UntornBody
{
public:
  using Vector = dealii::Vector<double>;
  using Tensor = dealii::Tensor<1, dim>;

  /// A boundary face: nodes by ascending (y, x) of the flat box.
  struct Face
  {
    std::vector<unsigned int> nodes;
  };

  UntornBody(const TestScene<dim> &scene, unsigned int index);

  unsigned int n_dofs() const { return handler.n_dofs(); }

  /// Nodal vector of a field's values, and the field at one node.
  Tensor at_node(const Vector &field, unsigned int node) const
  {
    Tensor value;
    for (unsigned int c = 0; c < dim; ++c)
      value[c] = field(node_dofs[node][c]);
    return value;
  }

  /// Stiffness and load at @p positions; constrained dofs condensed.
  void assemble(dealii::SparseMatrix<double> &K, Vector &f) const;

  std::vector<Face> faces(unsigned int boundary) const;

  /// int N_a dA over a boundary, shares of hanging nodes at their masters.
  std::vector<double> areas(unsigned int boundary) const;

  const TestBody<dim>                       &body;
  dealii::Triangulation<dim>                 triangulation;
  dealii::FESystem<dim>                      fe;
  dealii::DoFHandler<dim>                    handler;
  dealii::AffineConstraints<double>          hanging, constraints;
  dealii::SparsityPattern                    pattern;
  Vector                                     reference, positions;
  std::vector<dealii::Point<dim>>            flat; ///< box positions of nodes
  std::vector<std::array<unsigned int, dim>> node_dofs;
  std::vector<unsigned int>                  node_of_dof;

private:
  const elasticity::Material &
  material(typename dealii::Triangulation<dim>::cell_iterator cell) const
  {
    while (cell->level() > 0)
      cell = cell->parent();
    return cell->center()[0] > body.core_from ? body.core : body.material;
  }

  void make_mesh();
  void pin_slides();
  void collect_nodes();
  void place_nodes(const TestScene<dim> &scene, bool moved);
  void add_springs(const dealii::MappingFEField<dim> &mapping,
                   dealii::SparseMatrix<double>      &K) const;
  void add_loads(const dealii::MappingFEField<dim> &mapping, Vector &f) const;
};

template <int dim>
UntornBody<dim>::UntornBody(const TestScene<dim> &scene, unsigned int index)
  : body(scene.bodies[index]), fe(dealii::FE_Q<dim>(scene.degree), dim), handler(triangulation)
{
  make_mesh();
  handler.distribute_dofs(fe);
  dealii::DoFTools::make_hanging_node_constraints(handler, hanging);
  hanging.close();
  dealii::DoFTools::make_hanging_node_constraints(handler, constraints);
  for (const auto &support : body.supports)
    {
      dealii::ComponentMask mask(dim, false);
      for (const unsigned int c : support.second)
        mask.set(c, true);
      dealii::DoFTools::make_zero_boundary_constraints(handler, support.first, constraints, mask);
    }
  if (scene.punch_slides && index == 0)
    pin_slides();
  constraints.close();
  dealii::DynamicSparsityPattern dynamic(n_dofs());
  dealii::DoFTools::make_sparsity_pattern(handler, dynamic, constraints);
  pattern.copy_from(dynamic);
  collect_nodes();
  place_nodes(scene, false);
  place_nodes(scene, index == 1);
}

template <int dim>
void UntornBody<dim>::make_mesh()
{
  const bool colorize = true;
  dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, body.cells, body.corner,
                                                    body.corner + body.size, colorize);
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->center()[0] < body.refined_below)
      cell->set_refine_flag();
  triangulation.execute_coarsening_and_refinement();
}

/// Hold the horizontal motions, statically determinate: all but the last
/// component of the lower left corner, in 3D also y of another corner.
template <int dim>
void UntornBody<dim>::pin_slides()
{
  dealii::Point<dim> right = body.corner;
  right[0] += body.size[0];
  for (const auto &cell : handler.active_cell_iterators())
    for (const unsigned int v : cell->vertex_indices())
      {
        if (cell->vertex(v).distance(body.corner) < 1e-10)
          for (unsigned int d = 0; d + 1 < dim; ++d)
            constraints.add_line(cell->vertex_dof_index(v, d));
        if (dim == 3 && cell->vertex(v).distance(right) < 1e-10)
          constraints.add_line(cell->vertex_dof_index(v, 1));
      }
}

template <int dim>
void UntornBody<dim>::collect_nodes()
{
  std::vector<dealii::Point<dim>> support(n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(dealii::MappingQ1<dim>(), handler, support);
  // two dofs may share a point (Q2, hanging): a node is named by the dof of
  // its first component
  std::map<unsigned int, unsigned int>         nodes;
  std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
  node_of_dof.resize(n_dofs());
  for (const auto &cell : handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          const auto         local = fe.system_to_component_index(i);
          const unsigned int first = dofs[fe.component_to_system_index(0, local.second)];
          const auto         entry = nodes.emplace(first, unsigned(nodes.size()));
          if (entry.second)
            {
              flat.push_back(support[first]);
              node_dofs.emplace_back();
            }
          const unsigned int node      = entry.first->second;
          node_dofs[node][local.first] = dofs[i];
          node_of_dof[dofs[i]]         = node;
        }
    }
}

template <int dim>
void UntornBody<dim>::place_nodes(const TestScene<dim> &scene, bool moved)
{
  Vector &x = moved ? positions : reference;
  x.reinit(n_dofs());
  for (unsigned int node = 0; node < flat.size(); ++node)
    {
      dealii::Tensor<1, dim> f, p = flat[node];
      double                 square = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        f[d] = (p[d] - body.corner[d]) / body.size[d];
      for (unsigned int d = 0; d + 1 < dim; ++d)
        square += std::pow((f[d] - 0.5) * body.size[d], 2);
      if (body.radius > 0.)
        p[dim - 1] +=
          (1. - f[dim - 1]) * (body.radius - std::sqrt(body.radius * body.radius - square));
      if (moved)
        p[dim - 1] += f[dim - 1] *
                      bezier_height(scene.control_points, scene.design, f[0], dim == 3 ? f[1] : 0.);
      for (unsigned int c = 0; c < dim; ++c)
        x(node_dofs[node][c]) = p[c];
    }
  hanging.distribute(x);
  if (!moved)
    positions = reference;
}

template <int dim>
void UntornBody<dim>::assemble(dealii::SparseMatrix<double> &K, Vector &f) const
{
  const dealii::MappingFEField<dim>        mapping(handler, positions);
  const dealii::QGauss<dim>                quadrature(fe.degree + 1);
  dealii::FEValues<dim>                    values(mapping, fe, quadrature,
                                                  dealii::update_gradients | dealii::update_values |
                                                    dealii::update_JxW_values);
  const dealii::FEValuesExtractors::Vector u(0);
  dealii::FEValues<dim>      flat_values(fe, quadrature, dealii::update_quadrature_points);
  const unsigned int         n = fe.n_dofs_per_cell();
  dealii::FullMatrix<double> cell_matrix(n, n);
  Vector                     cell_load(n);
  std::vector<dealii::types::global_dof_index> dofs(n);
  K.reinit(pattern);
  f.reinit(n_dofs());
  for (const auto &cell : handler.active_cell_iterators())
    {
      const double E  = material(cell).youngs_modulus;
      const double nu = material(cell).poissons_ratio;
      const double mu = E / (2. * (1. + nu)), la = 2. * mu * nu / (1. - 2. * nu);
      values.reinit(cell);
      flat_values.reinit(cell);
      cell_matrix = 0.;
      cell_load   = 0.;
      for (const unsigned int q : values.quadrature_point_indices())
        for (unsigned int i = 0; i < n; ++i)
          {
            const auto e_i = values[u].symmetric_gradient(i, q);
            cell_load(i) += values[u].value(i, q) * body.body_force * values.JxW(q);
            // the stress that holds the thermal strain; the reference of the body is flat
            if (body.temperature)
              cell_load(i) += E / (1. - 2. * nu) * material(cell).expansion *
                              body.temperature(flat_values.quadrature_point(q)) * trace(e_i) *
                              values.JxW(q);
            for (unsigned int j = 0; j < n; ++j)
              {
                const auto e_j = values[u].symmetric_gradient(j, q);
                cell_matrix(i, j) +=
                  (2. * mu * (e_i * e_j) + la * trace(e_i) * trace(e_j)) * values.JxW(q);
              }
          }
      cell->get_dof_indices(dofs);
      constraints.distribute_local_to_global(cell_matrix, cell_load, dofs, K, f);
    }
  add_loads(mapping, f);
  add_springs(mapping, K);
}

template <int dim>
void UntornBody<dim>::add_springs(const dealii::MappingFEField<dim> &mapping,
                                  dealii::SparseMatrix<double>      &K) const
{
  dealii::FEFaceValues<dim>  values(mapping, fe, dealii::QGauss<dim - 1>(fe.degree + 1),
                                    dealii::update_values | dealii::update_JxW_values);
  const unsigned int         n = fe.n_dofs_per_cell();
  dealii::FullMatrix<double> matrix(n, n);
  std::vector<dealii::types::global_dof_index> dofs(n);
  for (const auto &cell : handler.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
      {
        if (!cell->at_boundary(face) || body.springs.count(cell->face(face)->boundary_id()) == 0)
          continue;
        values.reinit(cell, face);
        matrix = 0.;
        for (const auto &[component, k] : body.springs.at(cell->face(face)->boundary_id()))
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              if (fe.system_to_component_index(i).first == component &&
                  fe.system_to_component_index(j).first == component)
                for (const unsigned int q : values.quadrature_point_indices())
                  matrix(i, j) +=
                    k * values.shape_value(i, q) * values.shape_value(j, q) * values.JxW(q);
        cell->get_dof_indices(dofs);
        constraints.distribute_local_to_global(matrix, dofs, K);
      }
}

template <int dim>
void UntornBody<dim>::add_loads(const dealii::MappingFEField<dim> &mapping, Vector &f) const
{
  dealii::FEFaceValues<dim> values(mapping, fe, dealii::QGauss<dim - 1>(fe.degree + 1),
                                   dealii::update_values | dealii::update_normal_vectors |
                                     dealii::update_JxW_values);
  const dealii::FEValuesExtractors::Vector     u(0);
  Vector                                       load(fe.n_dofs_per_cell());
  std::vector<dealii::types::global_dof_index> dofs(load.size());
  for (const auto &cell : handler.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
      {
        if (!cell->at_boundary(face) || body.loads.count(cell->face(face)->boundary_id()) == 0)
          continue;
        const auto &given = body.loads.at(cell->face(face)->boundary_id());
        values.reinit(cell, face);
        load = 0.;
        for (const unsigned int q : values.quadrature_point_indices())
          for (unsigned int i = 0; i < load.size(); ++i)
            load(i) += values[u].value(i, q) *
                       (given.traction - given.pressure * values.normal_vector(q)) * values.JxW(q);
        cell->get_dof_indices(dofs);
        constraints.distribute_local_to_global(load, dofs, f);
      }
}

template <int dim>
std::vector<typename UntornBody<dim>::Face> UntornBody<dim>::faces(unsigned int boundary) const
{
  std::vector<Face>                            result;
  std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_face());
  for (const auto &cell : handler.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->at_boundary(f) && cell->face(f)->boundary_id() == boundary)
        {
          cell->face(f)->get_dof_indices(dofs);
          std::map<std::array<long, dim>, unsigned int> sorted;
          for (const unsigned int dof : dofs)
            {
              auto key = node_key<dim>(flat[node_of_dof[dof]]);
              std::reverse(key.begin(), key.end());
              sorted[key] = node_of_dof[dof];
            }
          result.emplace_back();
          for (const auto &entry : sorted)
            result.back().nodes.push_back(entry.second);
        }
  return result;
}

template <int dim>
std::vector<double> UntornBody<dim>::areas(unsigned int boundary) const
{
  const dealii::MappingFEField<dim> mapping(handler, positions);
  // int N_a |t1 x t2| is no polynomial: the same rule as
  // contact/tributary.cc
  dealii::FEFaceValues<dim> values(mapping, fe, dealii::QGauss<dim - 1>(fe.degree + 2),
                                   dealii::update_values | dealii::update_JxW_values);
  Vector                    x_part(fe.n_dofs_per_cell()), sum(n_dofs());
  std::vector<dealii::types::global_dof_index> dofs(x_part.size());
  for (const auto &cell : handler.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->at_boundary(f) && cell->face(f)->boundary_id() == boundary)
        {
          values.reinit(cell, f);
          x_part = 0.;
          for (const unsigned int q : values.quadrature_point_indices())
            for (unsigned int i = 0; i < x_part.size(); ++i)
              if (fe.system_to_component_index(i).first == 0)
                x_part(i) += values.shape_value(i, q) * values.JxW(q);
          cell->get_dof_indices(dofs);
          hanging.distribute_local_to_global(x_part, dofs, sum);
        }
  std::vector<double> result;
  for (const auto &of_node : node_dofs)
    result.push_back(sum(of_node[0]));
  return result;
}
} // namespace snug::test

#endif
