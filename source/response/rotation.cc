#include <snug/response/measured_faces.h>
#include <snug/response/quantities.h>
#include <snug/state/contact_results.h>

#include <deal.II/base/mpi.h>

namespace snug::response {
namespace {
template <int dim>
using Nodes = std::vector<dealii::Tensor<1, dim>>;

/// The rotation is the work of a unit moment that is spread over the boundary like an applied
/// moment, so all of its derivatives are those of such a load.
template <int dim>
class Rotation : public Response<dim>
{
public:
  explicit Rotation(const ResponseParameters &parameters) : parameters(parameters) {}

  std::vector<std::string> entries() const override { return {"Face", "Component"}; }

  void check(const state::StateSolver<dim> &solver) const override
  {
    find_boundary(solver, parameters);
    axis_of<dim>(parameters);
  }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    const UnitMoment unit(*this, solver);
    double           sum = 0.;
    unit.for_each_face(state.positions, [&](const MeasuredFace &face, const Nodes<dim> &f) {
      const auto u = at_face<dim>(face, solver.assemblers()[face.subdomain]->cell_values(
                                          face.cell, state.u[face.subdomain].column(0)));
      for (unsigned int a = 0; a < f.size(); ++a)
        sum += f[a] * u[a];
    });
    return dealii::Utilities::MPI::sum(sum, solver.context().communicator());
  }

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override
  {
    const UnitMoment unit(*this, solver);
    Partials<dim>    result;
    result.positions.resize(solver.mesh().n_points());
    for (const auto &assembler : solver.assemblers())
      result.u.emplace_back(assembler->n_dofs());
    unit.for_each_face(state.positions, [&](const MeasuredFace &face, const Nodes<dim> &f) {
      const auto &assembler = *solver.assemblers()[face.subdomain];
      Nodes<dim>  in_cell(solver.mesh().cells()[assembler.cells()[face.cell]].nodes.size());
      for (unsigned int a = 0; a < f.size(); ++a)
        in_cell[face.places[a]] += f[a];
      assembler.add_cell_vector(face.cell, 1., in_cell, result.u[face.subdomain].column(0));
    });
    unit.resultants.add_work_gradient(0, state.positions, state::nodal_values(solver, state.u, 0),
                                      1., result.positions);
    return result;
  }

  FieldDerivative<dim> field_derivative(const state::StateSolver<dim>  &solver,
                                        const state::ContactState<dim> &state) const override
  {
    const UnitMoment     unit(*this, solver);
    FieldDerivative<dim> result;
    result.boundary = find_boundary(solver, parameters);
    result.traction = [t = unit.resultants.tractions(state.positions)[0].at(
                         result.boundary)](const dealii::Tensor<1, dim> & /*normal*/,
                                           const dealii::Tensor<1, dim> &x) { return t.value(x); };
    return result;
  }

private:
  const ResponseParameters parameters;

  /// A unit moment about the axis on the boundary.
  struct UnitMoment
  {
    UnitMoment(const Rotation &rotation, const state::StateSolver<dim> &solver)
      : solver(solver)
      , parameters(rotation.parameters)
      , boundary(find_boundary(solver, parameters))
      , load_cases{load_case(rotation)}
      , resultants(solver.mesh(), solver.face_load(), load_cases)
    {}

    /// Call add(face, forces at its nodes) for each face of this rank.
    template <typename Add>
    void for_each_face(const mesh::Field<dim> &positions, const Add &add) const
    {
      const auto tractions = resultants.tractions(positions);
      for (const auto &face : faces_of(solver, parameters))
        {
          const auto &assembler = *solver.assemblers()[face.subdomain];
          const auto  X         = at_face<dim>(face, assembler.cell_field(face.cell, positions));
          Nodes<dim>  f;
          solver.face_load().force(X, {{}, {}, tractions[0].at(boundary)}, f);
          add(face, f);
        }
    }

    state::LoadCase<dim> load_case(const Rotation &rotation) const
    {
      state::LoadCase<dim> result;
      result.bodies.resize(solver.mesh().n_bodies());
      result.bodies[boundary.first].boundaries[boundary.second].resultant.moment =
        axis_of<dim>(rotation.parameters);
      return result;
    }

    const state::StateSolver<dim>              &solver;
    const ResponseParameters                   &parameters;
    const std::pair<unsigned int, unsigned int> boundary;
    const std::vector<state::LoadCase<dim>>     load_cases;
    const state::ResultantLoads<dim>            resultants;
  };
};
} // namespace

template <int dim>
std::unique_ptr<Response<dim>> rotation(const ResponseParameters &parameters)
{
  return std::make_unique<Rotation<dim>>(parameters);
}

template std::unique_ptr<Response<2>> rotation(const ResponseParameters &);
template std::unique_ptr<Response<3>> rotation(const ResponseParameters &);
} // namespace snug::response
