#include <snug/base/errors.h>
#include <snug/qp/pcpg.h>
#include <snug/state/body_boxes.h>
#include <snug/state/body_extents.h>
#include <snug/state/certificate.h>
#include <snug/state/describe.h>
#include <snug/state/state_solver.h>
#include <snug/state/subdomain_table.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug
{
  namespace state
  {
    namespace
    {
      /// The KKT residual is a norm over all rows, the certificate a maximum:
      /// solving this much below the tolerance meets it at once, as a rule.
      const double certificate_margin = 0.25;

      /// Cells below this quality are not solved (see Element::quality).
      const double least_quality = 0.02;
    } // namespace

    template <int dim>
    struct StateSolver<dim>::Data
    {
      Data(const mesh::BodyMesh<dim> &mesh,
           const mesh::Tearing       &tearing,
           const Model<dim>          &model,
           RunContext                &context)
        : mesh(mesh)
        , tearing(tearing)
        , model(model)
        , context(context)
        , face_load(mesh.degree(), mesh.idealization())
        , surface(mesh, contact::boundaries_of(model.pairs))
      {
        for (const auto &body : model.bodies)
          elements.emplace_back(mesh.degree(),
                                mesh.idealization(),
                                body.formulation);
      }

      const mesh::BodyMesh<dim>                   &mesh;
      const mesh::Tearing                         &tearing;
      Model<dim>                                   model;
      RunContext                                  &context;
      std::vector<elasticity::Element<dim>>        elements; ///< per body
      elasticity::FaceLoad<dim>                    face_load;
      mesh::Surface<dim>                           surface;
      std::unique_ptr<contact::Contact<dim>>       contact;
      std::unique_ptr<HeldNodes<dim>>              held;
      std::unique_ptr<Gluing<dim>>                 gluing;
      std::vector<std::unique_ptr<Assembler<dim>>> assemblers;
      std::vector<feti::SubdomainSystem>           systems;
      std::unique_ptr<feti::TotalFeti>             feti;
      std::vector<BodyBox<dim>>                    boxes;
      Field                                        last_positions;
      double solved_to = 0.; ///< KKT tolerance of the last solve

      void
      set_up(const Field &positions);
      void
      glue(const Field &positions);
      std::vector<bool>
      moved_subdomains(const Field &positions) const;
      void
      check_quality(const Field             &positions,
                    const std::vector<bool> &moved) const;
      void
      assemble(const Field &positions, const std::vector<bool> &moved);
      RowCoefficients<dim>
      rows(const Field &positions) const;
      void
      check_vanished_rows(const RowCoefficients<dim> &rows) const;
      void
      solve_to_certificate(const qp::WarmStart &start,
                           ContactState<dim>   &state);
    };

    template <int dim>
    void
    StateSolver<dim>::Data::set_up(const Field &positions)
    {
      const RunContext::Timer timer(context, "setup");
      boxes = body_boxes(mesh);
      if (mesh.idealization().is_axisymmetric())
        check_radii(mesh, model.body_names);
      held =
        std::make_unique<HeldNodes<dim>>(mesh, model.supports, 1, positions);
      contact =
        std::make_unique<contact::Contact<dim>>(surface,
                                                model.pairs,
                                                mesh.degree(),
                                                surface.gather(positions),
                                                held->directions(surface,
                                                                 positions));
      systems.resize(tearing.subdomains.size());
      for (unsigned int s = 0; s < systems.size(); ++s)
        {
          const auto &subdomain = tearing.subdomains[s];
          assemblers.push_back(
            std::make_unique<Assembler<dim>>(mesh,
                                             subdomain,
                                             model.bodies[subdomain.body],
                                             elements[subdomain.body],
                                             face_load));
          systems[s].body        = subdomain.body;
          systems[s].K           = assemblers[s]->sparsity();
          systems[s].fixing_dofs = assemblers[s]->fixing_dofs(positions);
        }
      glue(positions);
    }

    /// Everything that depends on which nodes are paired.
    template <int dim>
    void
    StateSolver<dim>::Data::glue(const Field &positions)
    {
      const auto reference = rows(positions);
      feti.reset();
      gluing =
        std::make_unique<Gluing<dim>>(mesh, tearing, surface, *held, reference);
      for (unsigned int s = 0; s < systems.size(); ++s)
        gluing->fill_B(s, reference, systems[s].B);
      feti = std::make_unique<feti::TotalFeti>(
        systems,
        gluing->layout(),
        subdomain_table(mesh, tearing, model.body_names),
        model.feti,
        context);
      last_positions.clear();
    }

    template <int dim>
    std::vector<bool>
    StateSolver<dim>::Data::moved_subdomains(const Field &positions) const
    {
      std::vector<bool> moved(systems.size(), last_positions.empty());
      if (last_positions.empty())
        return moved;
      for (unsigned int s = 0; s < systems.size(); ++s)
        for (const unsigned int cell : tearing.subdomains[s].cells)
          for (const unsigned int node : mesh.cells()[cell].nodes)
            if (positions[node] != last_positions[node])
              moved[s] = true;
      return moved;
    }

    template <int dim>
    void
    StateSolver<dim>::Data::check_quality(const Field             &positions,
                                          const std::vector<bool> &moved) const
    {
      if (mesh.idealization().is_axisymmetric())
        check_axis(mesh, positions, boxes);
      for (unsigned int s = 0; s < systems.size(); ++s)
        if (moved[s])
          for (unsigned int i = 0; i < assemblers[s]->cells().size(); ++i)
            {
              const auto   X       = assemblers[s]->cell_field(i, positions);
              const double quality = assemblers[s]->element().quality(X);
              if (quality >= least_quality)
                continue;
              std::ostringstream text;
              text << "the mesh of body " << model.body_names[systems[s].body]
                   << " is tangled near (" << X.front() << "): cell quality "
                   << quality << " is below " << least_quality
                   << "; tighten the bounds of the shape";
              throw TangledMesh(text.str());
            }
    }

    template <int dim>
    void
    StateSolver<dim>::Data::assemble(const Field             &positions,
                                     const std::vector<bool> &moved)
    {
      const RunContext::Timer timer(context, "assembly");
      for (unsigned int s = 0; s < systems.size(); ++s)
        if (moved[s])
          {
            auto &system = systems[s];
            assemblers[s]->stiffness(positions, system.K);
            system.f = assemblers[s]->load(positions);
            assemblers[s]->rigid_modes(positions,
                                       boxes[system.body].centre,
                                       boxes[system.body].length,
                                       system.R,
                                       system.Z);
            ++context.work.assembled_subdomains;
          }
    }

    template <int dim>
    RowCoefficients<dim>
    StateSolver<dim>::Data::rows(const Field &positions) const
    {
      return {contact->rows(surface.gather(positions)),
              held->frames(positions)};
    }

    template <int dim>
    void
    StateSolver<dim>::Data::check_vanished_rows(
      const RowCoefficients<dim> &rows) const
    {
      double length = 0.;
      for (const auto &box : boxes)
        length = std::max(length, box.length);
      for (const unsigned int i : gluing->vanished_rows())
        if (gluing->gap(i, rows, 0) < -1e-10 * length)
          {
            std::ostringstream text;
            text << "no equilibrium: contact row " << i << " overlaps by "
                 << -gluing->gap(i, rows, 0)
                 << " between nodes that are held in its direction";
            throw SolveError(text.str());
          }
    }

    template <int dim>
    void
    StateSolver<dim>::Data::solve_to_certificate(const qp::WarmStart &start,
                                                 ContactState<dim>   &state)
    {
      qp::WarmStart        from       = start;
      qp::SolverParameters parameters = model.solver;
      const double         wanted     = parameters.relative_tolerance;
      parameters.relative_tolerance *= certificate_margin;
      const unsigned long mults = context.work.f_mults;
      unsigned int        outer = 0;
      for (unsigned int attempt = 0; attempt < 5; ++attempt)
        {
          const auto this_solver =
            choose(qp::solver_table(), parameters.method).make(parameters);
          state.dual = this_solver->solve(*feti, from);
          outer += state.dual.outer_iterations;
          state.u           = feti->recover(feti->loads(),
                                  state.dual.lambda,
                                  state.dual.amplitudes);
          state.certificate = certify(*feti, state.dual.lambda, state.u);
          if (state.certificate.worst() <= wanted)
            {
              solved_to                   = parameters.relative_tolerance;
              state.dual.outer_iterations = outer;
              state.f_mults               = context.work.f_mults - mults;
              return;
            }
          from.lambda = state.dual.lambda;
          from.active = state.dual.active;
          parameters.relative_tolerance *= certificate_margin;
        }
      std::ostringstream text;
      text << "the certificate of the contact state stays at "
           << state.certificate.worst() << ", above the tolerance " << wanted
           << "; allow a larger 'Solver/Relative tolerance'";
      throw SolveError(text.str());
    }

    template <int dim>
    StateSolver<dim>::StateSolver(const mesh::BodyMesh<dim> &mesh,
                                  const mesh::Tearing       &tearing,
                                  const Model<dim>          &model,
                                  const Field               &positions,
                                  RunContext                &context)
      : data(std::make_unique<Data>(mesh, tearing, model, context))
    {
      data->set_up(positions);
    }

    template <int dim>
    StateSolver<dim>::~StateSolver() = default;

    template <int dim>
    void
    StateSolver<dim>::pair(const Field &positions)
    {
      const RunContext::Timer timer(data->context, "setup");
      data->contact->pair(data->surface.gather(positions),
                          data->held->directions(data->surface, positions));
      data->glue(positions);
    }

    template <int dim>
    ContactState<dim>
    StateSolver<dim>::solve(const Field &positions, const qp::WarmStart &start)
    {
      const auto moved = data->moved_subdomains(positions);
      everywhere(data->context.communicator(),
                 [&]() { data->check_quality(positions, moved); });
      const auto rows = data->rows(positions);
      data->check_vanished_rows(rows);
      data->last_positions.clear();
      data->assemble(positions, moved);
      for (unsigned int s = 0; s < data->systems.size(); ++s)
        data->gluing->fill_B(s, rows, data->systems[s].B);
      data->feti->update(moved, data->gluing->right_hand_side(rows, 0));
      data->last_positions = positions;
      ContactState<dim> state;
      state.positions = positions;
      {
        const RunContext::Timer timer(data->context, "solve");
        data->solve_to_certificate(start, state);
      }
      describe(*this, rows, state);
      return state;
    }

    template <int dim>
    unsigned long
    StateSolver<dim>::linear_f_mults(const ContactState<dim> &state) const
    {
      const auto         &feti   = *data->feti;
      const auto          face   = feti.face(state.dual.active);
      const unsigned long before = data->context.work.f_mults;
      qp::MultiVector     lambda(feti.n_owned());
      face->make_feasible(lambda, feti.e());
      qp::MultiVector residual = feti.d();
      residual.add(-1., feti.apply(lambda));
      qp::MultiVector projected = residual;
      face->project(projected);
      const double scale =
        qp::norms(projected, data->context.communicator())[0];
      qp::pcpg(feti,
               *face,
               lambda,
               residual,
               {data->solved_to * scale},
               data->model.solver.max_iterations);
      return data->context.work.f_mults - before;
    }

    template <int dim>
    double
    StateSolver<dim>::volume(unsigned int body, const Field &positions) const
    {
      double volume = 0.;
      for (unsigned int s = 0; s < data->systems.size(); ++s)
        if (data->systems[s].body == body)
          for (unsigned int i = 0; i < data->assemblers[s]->cells().size(); ++i)
            volume += data->assemblers[s]->element().volume(
              data->assemblers[s]->cell_field(i, positions));
      return dealii::Utilities::MPI::sum(volume, data->context.communicator());
    }

    template <int dim>
    RowCoefficients<dim>
    StateSolver<dim>::rows(const Field &positions) const
    {
      return data->rows(positions);
    }

    template <int dim>
    RowCoefficients<dim>
    StateSolver<dim>::row_derivatives(const Field &positions,
                                      const Field &velocity) const
    {
      return {data->contact->row_derivatives(data->surface.gather(positions),
                                             data->surface.gather(velocity)),
              data->held->frame_derivatives(positions, velocity)};
    }

#define SNUG_GETTER(type, name, value) \
  template <int dim>                   \
  type StateSolver<dim>::name() const  \
  {                                    \
    return value;                      \
  }
    SNUG_GETTER(const mesh::BodyMesh<dim> &, mesh, data->mesh)
    SNUG_GETTER(const mesh::Tearing &, tearing, data->tearing)
    SNUG_GETTER(const Model<dim> &, model, data->model)
    SNUG_GETTER(const mesh::Surface<dim> &, surface, data->surface)
    SNUG_GETTER(const contact::Contact<dim> &, contact, *data->contact)
    SNUG_GETTER(const HeldNodes<dim> &, held, *data->held)
    SNUG_GETTER(const elasticity::FaceLoad<dim> &, face_load, data->face_load)
    SNUG_GETTER(const std::vector<std::unique_ptr<Assembler<dim>>> &,
                assemblers,
                data->assemblers)
    SNUG_GETTER(const feti::TotalFeti &, feti, *data->feti)
    SNUG_GETTER(const Gluing<dim> &, gluing, *data->gluing)
    SNUG_GETTER(RunContext &, context, data->context)
#undef SNUG_GETTER

    template class StateSolver<2>;
    template class StateSolver<3>;
  } // namespace state
} // namespace snug
