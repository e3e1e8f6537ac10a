'use strict';
// What happened at an event and why, in words.

const ordinal_kinds = { 1: 'vertex', 2: 'edge', 3: 'facet' };

// "facet (3, 17, 20)"
function name_of_caller(corners) {
  if (corners.length === 0) return '';
  const kind = ordinal_kinds[corners.length];
  return corners.length === 1 ? `${kind} ${corners[0]}` : `${kind} (${corners.join(', ')})`;
}

const sentence = (text) => {
  const trimmed = text.trim();
  const whole = /[.!?]$/.test(trimmed) ? trimmed : trimmed + '.';
  return whole[0].toUpperCase() + whole.slice(1);
};

// {title, where, lines: [[kind, text, heading], ...]}; kind names a style: why, done, refused, or
// nothing; a line may have a heading.
function tell_event(trace, e) {
  const routine = trace.routine(e), reason = trace.reason(e);
  const caller = name_of_caller(trace.caller(e)), value = trace.value(e);
  const vertex = trace.vertex(e), place = trace.place(e), outcome = trace.outcome(e);
  const refused = trace.refused(e), lines = [];

  if (routine.text) lines.push(['', sentence(routine.text)]);
  if (reason && (reason.name || reason.text)) {
    // A reason's text ends with what the value is: "... over ...; value: times the limit".
    const [meaning, unit = ''] = reason.text.split('; value: ');
    const by = caller ? ` of ${caller}` : '';
    const number = Number.isFinite(value) ? `; ${unit || 'value'}: ${rounded(value)}` : '';
    lines.push(['why', `${by}: ${meaning}${number}.`, reason.name]);
  } else if (caller) {
    lines.push(['why', sentence(`${caller} called for it`)]);
  }
  if (vertex !== kNone) {
    const at = place ? ` at (${Array.from(place, rounded).join(', ')})` : '';
    lines.push(['done', `Vertex ${vertex} comes in${at}.`]);
  } else if (refused) {
    const test = outcome.replace(/^refused:? */, '');
    const why = trace.outcome_text(e);
    lines.push(['refused', sentence(`Refused${test ? `, \u201c${test}\u201d` : ''}` +
                                    `${why ? `: ${why}` : ''}`) + ' Nothing is changed.']);
  } else if (outcome !== 'done') {
    lines.push(['', sentence(trace.outcome_text(e) || outcome)]);
  }
  const counts = count_changes(trace, e);
  if (counts) lines.push(['', counts]);
  const figure = routine.figure ? `, Figure ${routine.figure}` : '';
  const plain = kOperations[routine.name]?.label;
  const title = plain && plain !== routine.name ? `${plain} (${routine.name})` : routine.name;
  return { title, where: `Stage ${trace.stage(e)}${figure}`, lines };
}

function count_changes(trace, e) {
  const parts = [];
  const say = (name, one, many, before = '', after = '') => {
    const n = trace.size(name, e);
    if (n > 0) parts.push(before + counted(n, one, many) + after);
  };
  say('hits', 'time', 'times', 'the Voronoi edge meets the surface ');
  say('zone', 'tetrahedron', 'tetrahedra', '', trace.size('zone', e) === 1 ? ' is in the conflict zone'
                                                                          : ' are in the conflict zone');
  say('star', 'facet', 'facets', '', ' looked at');
  say('cone', 'facet', 'facets', '', ' proposed in their place');
  say('removed', 'facet goes', 'facets go');
  say('added', 'facet comes', 'facets come');
  say('relabel', 'vertex', 'vertices', '', ' of T change region');
  return parts.length > 0 ? sentence(parts.join(', ')) : '';
}
