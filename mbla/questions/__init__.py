"""What load cases ask: one file a question, from the load factor λ that is solved for to the figure that answers it."""

from mbla.questions.question import Question as Question
