#include "cells.h"

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe_field.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <deal.II/lac/vector.h>

using namespace elasticity_cells;

/// One cell of deal.II with its nodes moved to X, and its own integration.
template <typename Case>
class DealIIAssembly : public ::testing::Test
{
public:
  static constexpr int          dim    = Case::dim;
  static constexpr unsigned int degree = Case::degree;

  const Element<dim>          element{degree};
  const Nodes<dim>            X = distorted<dim>(degree, 21);
  dealii::Triangulation<dim>  triangulation;
  const dealii::FESystem<dim> fe{dealii::FE_Q<dim>(degree), dim};
  dealii::DoFHandler<dim>     dof_handler{triangulation};
  dealii::Vector<double>      positions;
  /// unknown of Element of each unknown of fe
  std::vector<unsigned int> unknowns;

  DealIIAssembly()
  {
    dealii::GridGenerator::hyper_cube(triangulation);
    dof_handler.distribute_dofs(fe);
    for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
      {
        const auto   support = fe.unit_support_point(i);
        unsigned int node = 0, stride = 1;
        for (unsigned int d = 0; d < dim; ++d, stride *= degree + 1)
          node += stride * std::lround(support[d] * degree);
        unknowns.push_back(dim * node + fe.system_to_component_index(i).first);
      }
    std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
    dof_handler.begin_active()->get_dof_indices(dofs);
    positions.reinit(dofs.size());
    for (unsigned int i = 0; i < dofs.size(); ++i)
      positions[dofs[i]] = X[unknowns[i] / dim][unknowns[i] % dim];
  }
};
TYPED_TEST_SUITE(DealIIAssembly, AllCases);

TYPED_TEST(DealIIAssembly, GivesTheSameStiffnessVolumeAndBodyForce)
{
  constexpr int                            dim = TestFixture::dim;
  const dealii::MappingFEField<dim>        mapping(this->dof_handler, this->positions);
  const dealii::QGauss<dim>                quadrature(TestFixture::degree + 1);
  const dealii::FEValuesExtractors::Vector displacement(0);
  dealii::FEValues<dim>                    values(mapping, this->fe, quadrature,
                                                  dealii::update_values | dealii::update_gradients |
                                                    dealii::update_JxW_values);
  values.reinit(this->dof_handler.begin_active());
  const auto &view = values[displacement];

  // of the Gauss points in the order of QGauss
  const auto          b = random_field<dim>(quadrature.size(), 5);
  const unsigned int  n = this->unknowns.size();
  std::vector<double> K(n * n);
  Nodes<dim>          f(this->X.size());
  double              volume = 0.;
  for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      volume += values.JxW(q);
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int row = this->unknowns[i];
          f[row / dim][row % dim] += view.value(i, q) * b[q] * values.JxW(q);
          for (unsigned int j = 0; j < n; ++j)
            K[row * n + this->unknowns[j]] +=
              (2. * material.lame_mu() *
                 (view.symmetric_gradient(i, q) * view.symmetric_gradient(j, q)) +
               material.lame_lambda() * view.divergence(i, q) * view.divergence(j, q)) *
              values.JxW(q);
        }
    }

  std::vector<double> found;
  Nodes<dim>          f_found;
  this->element.stiffness(this->X, material, found);
  this->element.body_force(this->X, b, f_found);
  const double scale = largest(K);
  for (unsigned int i = 0; i < K.size(); ++i)
    EXPECT_NEAR(found[i], K[i], 1e-13 * scale);
  EXPECT_NEAR(this->element.volume(this->X), volume, 1e-13 * volume);
  EXPECT_LT(distance<dim>(f_found, f), 1e-13 * norm<dim>(f));
}

TYPED_TEST(DealIIAssembly, GivesTheSameFaceLoads)
{
  constexpr int                     dim      = TestFixture::dim;
  const double                      pressure = 3.;
  const auto                        traction = random_field<dim>(1, 6)[0];
  const dealii::MappingFEField<dim> mapping(this->dof_handler, this->positions);
  const dealii::QGauss<dim - 1>     quadrature(TestFixture::degree + 1);
  dealii::FEFaceValues<dim>         values(mapping, this->fe, quadrature,
                                           dealii::update_values | dealii::update_normal_vectors |
                                             dealii::update_JxW_values);
  const FaceLoad<dim>               load(TestFixture::degree);

  for (unsigned int face = 0; face < 2 * dim; ++face)
    {
      values.reinit(this->dof_handler.begin_active(), face);
      Nodes<dim>          f(this->X.size());
      std::vector<double> areas(this->X.size());
      for (unsigned int i = 0; i < this->unknowns.size(); ++i)
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const unsigned int node      = this->unknowns[i] / dim;
            const unsigned int component = this->unknowns[i] % dim;
            const double       share     = values.shape_value(i, q) * values.JxW(q);
            f[node][component] +=
              share * (traction[component] - pressure * values.normal_vector(q)[component]);
            if (component == 0)
              areas[node] += share;
          }

      const auto nodes = face_nodes<dim>(TestFixture::degree, face / 2, face % 2 == 1);
      Nodes<dim> found;
      load.force(extract<dim>(this->X, nodes),
                 {std::vector<double>(nodes.size(), pressure),
                  Nodes<dim>(nodes.size(), traction),
                  {}},
                 found);
      const auto areas_found = load.areas(extract<dim>(this->X, nodes));
      const auto expected    = extract<dim>(f, nodes);
      EXPECT_LT(distance<dim>(found, expected), 1e-13 * norm<dim>(expected));
      for (unsigned int i = 0; i < nodes.size(); ++i)
        EXPECT_NEAR(areas_found[i], areas[nodes[i]], 1e-13);
    }
}
