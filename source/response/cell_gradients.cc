#include <snug/response/cell_gradients.h>

namespace snug
{
  namespace response
  {
    namespace
    {
      template <int dim>
      void
      add_to_nodes(const std::vector<unsigned int>           &nodes,
                   const std::vector<dealii::Tensor<1, dim>> &values,
                   typename mesh::BodyMesh<dim>::Field       &gradient)
      {
        for (unsigned int a = 0; a < nodes.size(); ++a)
          gradient[nodes[a]] += values[a];
      }
    } // namespace

    template <int dim>
    void
    add_stiffness_gradient(const state::StateSolver<dim>       &solver,
                           const state::ContactState<dim>      &state,
                           double                               factor,
                           typename mesh::BodyMesh<dim>::Field &gradient)
    {
      for (unsigned int s = 0; s < solver.assemblers().size(); ++s)
        {
          const auto &assembler = *solver.assemblers()[s];
          for (unsigned int i = 0; i < assembler.cells().size(); ++i)
            {
              const auto u = assembler.cell_values(i, state.u[s].column(0));
              std::vector<dealii::Tensor<1, dim>> values(u.size());
              solver.element().add_energy_gradient(
                assembler.cell_field(i, state.positions),
                assembler.body_model().material,
                u,
                u,
                factor,
                values);
              add_to_nodes<dim>(
                solver.mesh().cells()[assembler.cells()[i]].nodes,
                values,
                gradient);
            }
        }
    }

    template <int dim>
    void
    add_load_gradient(const state::StateSolver<dim>       &solver,
                      const state::ContactState<dim>      &state,
                      double                               factor,
                      typename mesh::BodyMesh<dim>::Field &gradient)
    {
      for (unsigned int s = 0; s < solver.assemblers().size(); ++s)
        {
          const auto &assembler = *solver.assemblers()[s];
          const auto &b         = assembler.body_model().body_force;
          if (b.norm() > 0.)
            for (unsigned int i = 0; i < assembler.cells().size(); ++i)
              {
                const auto u = assembler.cell_values(i, state.u[s].column(0));
                std::vector<dealii::Tensor<1, dim>> values(u.size());
                solver.element().add_body_force_gradient(
                  assembler.cell_field(i, state.positions),
                  b,
                  u,
                  factor,
                  values);
                add_to_nodes<dim>(
                  solver.mesh().cells()[assembler.cells()[i]].nodes,
                  values,
                  gradient);
              }
          for (unsigned int i = 0; i < assembler.loaded_faces().size(); ++i)
            {
              const auto u = assembler.face_values(i, state.u[s].column(0));
              std::vector<dealii::Tensor<1, dim>> values(u.size());
              const auto &load = assembler.face_model(i);
              solver.face_load().add_force_gradient(
                assembler.face_field(i, state.positions),
                load.pressure,
                load.traction,
                u,
                factor,
                values);
              add_to_nodes<dim>(solver.mesh()
                                  .boundary_faces()[assembler.loaded_faces()[i]]
                                  .nodes,
                                values,
                                gradient);
            }
        }
    }

    template <int dim>
    void
    add_contact_gradient(const state::StateSolver<dim>       &solver,
                         const state::ContactState<dim>      &state,
                         typename mesh::BodyMesh<dim>::Field &gradient)
    {
      const auto         &surface = solver.surface();
      std::vector<double> forces;
      for (const auto &point : state.contact)
        forces.push_back(point.force);
      const auto at_surface =
        solver.contact().energy_gradient(surface.gather(state.positions),
                                         surface.gather(state.displacement),
                                         forces);
      surface.add_owned(at_surface, gradient);
    }

#define SNUG_INSTANTIATE(dim)                                            \
  template void add_stiffness_gradient(const state::StateSolver<dim> &,  \
                                       const state::ContactState<dim> &, \
                                       double,                           \
                                       mesh::BodyMesh<dim>::Field &);    \
  template void add_load_gradient(const state::StateSolver<dim> &,       \
                                  const state::ContactState<dim> &,      \
                                  double,                                \
                                  mesh::BodyMesh<dim>::Field &);         \
  template void add_contact_gradient(const state::StateSolver<dim> &,    \
                                     const state::ContactState<dim> &,   \
                                     mesh::BodyMesh<dim>::Field &);
    SNUG_INSTANTIATE(2)
    SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
  } // namespace response
} // namespace snug
