// The walk: one oscillator's motion over whole mesh periods, cell by cell, event by event.
//
// A motion is { x, v, region } at the start of a mesh period; `walk` moves it on, and shows a visitor what it passes.
// The loop of gearpair/_flow/walk.py with the segments of segment.py, for an error of one harmonic: no blocks of cells.
// What is gathered there by accumulators is gathered here by visitors.
gearpair.define("flow", ["library", "closed_form", "cells", "certified"], function (library, closedForm, tables, certified) {
  const { TERMS, value, evaluate, expand, sineCosine } = closedForm;
  const { XX, XV, X0, VX, VV, V0, SX, SV, S0, COLUMNS } = tables;
  const { INSIDE, UNDECIDED, exit, regionAt, firstExit } = certified;
  const [OK, ESCAPED, TOO_MANY_EVENTS, EVENT_UNDECIDED] = [0, 1, 2, 3];
  const { MAX_EVENTS_PER_PERIOD } = library.tolerances;

  const series = new Float64Array(TERMS); // of the segment under way
  const ahead = new Float64Array(4); // after `followCell`: X and X' at the cell's end, lower and upper bound of X

  function startAt(cells, x, v) {
    return { x, v, region: regionAt(x, v, cells.force + cells.sine[0], cells.cosine[0]) };
  }

  // Look over cell `j` as if all of it were spent in the present region; whether that is certain.
  function followCell(cells, j, motion) {
    const { x, v, region } = motion;
    const maps = cells.maps;
    const row = (3 * j + region + 1) * COLUMNS;
    const x1 = maps[row + XX] * x + (maps[row + XV] * v + maps[row + X0]);
    const v1 = maps[row + VX] * x + (maps[row + VV] * v + maps[row + V0]);
    const third = cells.width[j] / 3;
    const b1 = x + third * v;
    const b2 = x1 - third * v1;
    const spread = maps[row + SX] * Math.abs(x - region) + (maps[row + SV] * Math.abs(v) + maps[row + S0]);
    const low = Math.min(x, b1, b2, x1) - spread;
    const high = Math.max(x, b1, b2, x1) + spread;
    ahead[0] = x1;
    ahead[1] = v1;
    ahead[2] = low;
    ahead[3] = high;
    return (region < 0 || low >= 2 * region - 1) && (region > 0 || high <= 2 * region + 1);
  }

  // Follow the motion in cell `j` from t (in widths of the cell) to its first exit or the cell's end: fills `series`,
  // moves the motion, and leaves the duration in `exit[0]`.
  function nextSegment(cells, j, t, motion) {
    const { x, v, region } = motion;
    const width = cells.width[j];
    const at = 2 * cells.level[j] + Math.abs(region);
    let sine = cells.sine[j];
    let cosine = cells.cosine[j];
    if (t > 0) {
      const turn = (t * width * 2 * Math.PI) / cells.period;
      const [s, c] = sineCosine(turn);
      [sine, cosine] = [sine * c + cosine * s, cosine * c - sine * s];
    }
    expand(cells.bases[at], region, x, v, cells.force, sine, cosine, series);
    const fourths = cells.fourths[at];
    let fourth = fourths[0] * Math.abs(x - region) + fourths[1] * Math.abs(v);
    fourth += fourths[2] * Math.abs(cells.force) + fourths[3] * Math.abs(sine) + fourths[4] * Math.abs(cosine);
    const end = 1 - t;
    let x1, v1;
    if (t === 0) {
      followCell(cells, j, motion);
      x1 = ahead[0];
      v1 = ahead[1];
    } else {
      evaluate(series, end);
      x1 = value[0];
      v1 = value[1] / width;
    }
    const outcome = firstExit(series, region, end, x1, v1 * width, fourth);
    if (outcome === INSIDE) {
      exit[0] = end;
      motion.x = x1;
      motion.v = v1;
    } else if (outcome !== UNDECIDED) {
      motion.x = exit[1];
      motion.v = exit[2] / width;
    }
    return outcome;
  }

  // Move the motion on by `periods` mesh periods; returns a status and stops early where it is not OK.
  //
  // A visitor is asked `whole(j, motion)` at each cell that the motion certainly spends in one region: true lets the
  // cell be passed by its map. Of other cells it is shown every segment, before the region changes:
  // `segment(period, j, t, duration, motion, crossed)`, the motion at its end, the power series in `series`.
  function walk(cells, motion, periods, visitor = null) {
    for (let period = 0; period < periods; period++) {
      let events = 0;
      for (let j = 0; j < cells.size; j++) {
        if (followCell(cells, j, motion) && (visitor === null || visitor.whole(j, motion))) {
          motion.x = ahead[0];
          motion.v = ahead[1];
          continue;
        }
        let t = 0;
        for (;;) {
          const outcome = nextSegment(cells, j, t, motion);
          if (outcome === UNDECIDED) return EVENT_UNDECIDED;
          const duration = exit[0];
          const crossed = outcome !== INSIDE;
          if (visitor !== null) visitor.segment(period, j, t, duration, motion, crossed);
          if (!crossed) break;
          t += duration;
          motion.region = motion.region === 0 ? Math.sign(motion.x) : 0;
          if (++events > MAX_EVENTS_PER_PERIOD) return TOO_MANY_EVENTS;
        }
      }
      if (!(Math.abs(motion.x) + Math.abs(motion.v) <= cells.escapeRadius)) return ESCAPED;
    }
    return OK;
  }

  return { OK, ESCAPED, TOO_MANY_EVENTS, EVENT_UNDECIDED, series, ahead, startAt, walk };
});
