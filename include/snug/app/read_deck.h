#ifndef snug_app_read_deck_h
#define snug_app_read_deck_h

#include <snug/app/command_line.h>
#include <snug/base/run_context.h>
#include <snug/deck/translation.h>
#include <snug/scene/read_scene.h>

namespace snug::app {
/// Replace a deck by its parameter file on this rank, and return the translation, which is empty
/// for other texts.
/// @throws InputError naming the file, also if the text must be a deck, but is not.
deck::Translation translate_deck(scene::SceneSource &source, bool must_be_deck);

/// List the parts of the model of a deck that the run lacks, and warn of those that others replace.
/// @throws InputError unless the option --leave-out accepts the kinds of all parts that are
/// lacking.
void report_translation(RunContext              &context,
                        const Options           &options,
                        const deck::Translation &translation);
} // namespace snug::app

#endif
